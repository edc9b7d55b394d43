// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace throng::tools {

/// The bytes as base64 (RFC 4648, padded).
std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace throng::tools
