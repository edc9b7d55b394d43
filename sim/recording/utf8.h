// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace throng::recording {

/// The length of the UTF-8 character at the start of `text`, 0 where there is none (RFC 3629).
std::size_t utf8_character(std::string_view text);

/// `text` with U+FFFD for each byte that belongs to no character, and for each NUL: what a recording may hold
/// of what the system hands us (names of files and users are bytes, not texts).
std::string as_utf8(std::string_view text);

}  // namespace throng::recording
