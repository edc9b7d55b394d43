// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace throng {

/// What a stranger gave us is unusable: a scenario, a recording, an option. The message is a whole sentence
/// for the user; the program ends with exit code 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace throng
