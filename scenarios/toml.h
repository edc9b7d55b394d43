// SPDX-License-Identifier: MIT
#pragma once

// The parser's library, linked rather than compiled into every file that reads.
#ifndef TOML_HEADER_ONLY
#define TOML_HEADER_ONLY 0
#endif
#ifndef TOML_SHARED_LIB
#define TOML_SHARED_LIB 1
#endif
#include <toml++/toml.h>
