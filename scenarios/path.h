// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace throng::scenarios {

/// Where in a file's tree we are: a chain on the stack, turned into text only for a message.
class Path {
 public:
  Path() = default;  ///< the root
  Path(const Path& parent, std::string_view key)
      : parent_(&parent), key_(key) {}  ///< `parent` must outlive it
  Path(const Path& parent, std::size_t index) : parent_(&parent), index_(index) {}

  /// "bodies[0].place.random"; a key that is no bare TOML key stands in quotes.
  std::string text() const;

 private:
  const Path* parent_ = nullptr;
  std::string_view key_;
  std::size_t index_ = kNoIndex;
  static constexpr std::size_t kNoIndex = static_cast<std::size_t>(-1);
};

/// True for a key that TOML writes without quotes: letters, digits, _ and -.
bool is_bare_key(std::string_view key);

}  // namespace throng::scenarios
