// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Before a function: it is compiled twice, and the form for wide vectors is taken where the
/// processor has them. Everything called in its loops is inlined into both forms.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define SIGLOC_WIDE_VECTORS __attribute__((target_clones("avx2", "default"), flatten))
#else
#define SIGLOC_WIDE_VECTORS
#endif
