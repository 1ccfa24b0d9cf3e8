/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file export.h
 * What every other header of wfpsf stands on: fixed-width integers and the export mark.
 */
#ifndef WFPSF_EXPORT_H
#define WFPSF_EXPORT_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__) || defined(__clang__)
#define WFPSF_EXPORT __attribute__((visibility("default")))
#else
#define WFPSF_EXPORT
#endif

#endif
