// To be included before Highway by what is compiled once for each instruction set.
#pragma once

// Vectors whose size is not known when compiling can be no members, and no elements of arrays.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

// The least that an x86-64 processor must have (2006). Without one Highway falls back to vectors of one lane.
#define HWY_WANT_SSSE3 1
