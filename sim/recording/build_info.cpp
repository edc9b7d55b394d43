// SPDX-License-Identifier: MIT
#include "sim/recording/build_info.h"

namespace throng::recording {

const char* version_text() {
  return THRONG_VERSION;
}

const char* compiler_text() {
#ifdef __clang__
  return __VERSION__;
#else
  return "g++ " __VERSION__;
#endif
}

const char* flags_text() {
  return THRONG_FLAGS;
}

}  // namespace throng::recording
