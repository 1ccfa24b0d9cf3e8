// SPDX-License-Identifier: GPL-3.0-or-later
// Run-time choice of vector instructions: a function marked WFPSF_VECTORISED is compiled for the
// baseline and for newer x86-64 processors, and the loader takes the best that the machine has. Its
// results may differ in the last bits from machine to machine, never from run to run. Sanitizers
// and other compilers or processors get the baseline.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) &&                             \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define WFPSF_VECTORISED                                                                           \
    __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define WFPSF_VECTORISED
#endif
