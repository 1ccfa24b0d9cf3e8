/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file wfpsf.h
 * Everything: WFIRST/Roman PSFs, interpixel capacitance, moments.
 */
#ifndef WFPSF_H
#define WFPSF_H

#include <wfpsf/catalogue.h>
#include <wfpsf/chain.h>
#include <wfpsf/design.h>
#include <wfpsf/exposure.h>
#include <wfpsf/image.h>
#include <wfpsf/instrument.h>
#include <wfpsf/ipc.h>
#include <wfpsf/moments.h>
#include <wfpsf/observation.h>
#include <wfpsf/options.h>
#include <wfpsf/otf.h>
#include <wfpsf/psf.h>
#include <wfpsf/scene.h>
#include <wfpsf/sed.h>
#include <wfpsf/size.h>
#include <wfpsf/sky.h>
#include <wfpsf/status.h>
#include <wfpsf/study.h>
#include <wfpsf/varying_ipc.h>
#include <wfpsf/varying_psf.h>
#include <wfpsf/version.h>

#endif
