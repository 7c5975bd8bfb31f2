// SPDX-License-Identifier: BSD-3-Clause
// Scalars that templated tests run for. Sanitizers ask what the code does with memory, which is the same for
// both; compiling it twice for them takes minutes.
#pragma once

#ifdef SSLAM_SANITIZED_TESTS
#define SSLAM_TEST_SCALARS double
#define SSLAM_TEST_TYPES(A, B, C) A<double>, B<double>, C<double>
#else
#define SSLAM_TEST_SCALARS float, double
#define SSLAM_TEST_TYPES(A, B, C) A<float>, A<double>, B<float>, B<double>, C<float>, C<double>
#endif
