#pragma once

// ELASTOLAB_TEST_SANITIZED: the tests run under a sanitizer, which has memory of its own.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define ELASTOLAB_TEST_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ELASTOLAB_TEST_SANITIZED
#endif
