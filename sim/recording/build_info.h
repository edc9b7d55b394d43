// SPDX-License-Identifier: MIT
#pragma once

/// What this program was built from and with, as every recording tells.
namespace throng::recording {

const char* version_text();   ///< of throng, such as "0.2.0"
const char* compiler_text();  ///< such as "g++ 12.2.0"
const char* flags_text();     ///< the build type and the compiler's flags

}  // namespace throng::recording
