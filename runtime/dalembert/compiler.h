/* SPDX-License-Identifier: BSL-1.0 */
/* g++ and gcc 12 make wrong code for AVX-512: copies between short arrays. 12.2 is seen to do so, 11.3 and clang are not. */
#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ == 12 && defined(__AVX512F__) && defined(__OPTIMIZE__) && !defined(DALEMBERT_TRUST_AVX512)
#define DALEMBERT_TRUST_AVX512 /* one warning a file is enough */
#warning "this compiler makes wrong code for AVX-512: add -mno-avx512f, or define DALEMBERT_TRUST_AVX512 where it was mended"
#endif
