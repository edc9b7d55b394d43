// SPDX-License-Identifier: MIT
#include <string_view>

#include "tools/bench/validation_cases.h"

namespace throng::bench {

namespace {

struct Nature {
  const char *model, *name, *why;  ///< `name`: how the case's begins; either empty: any
};

constexpr Nature kNatures[] = {
    {"constant_velocity", "", "agents see nobody"},
    {"collision_free_speed", "Seyfried 2009: flow through",
     "a passage lets through less than a door of its width: both follow from time_gap and size"},
    {"collision_free_speed", "faster is slower", "nobody presses on another"},
    {"orca", "faster is slower", "nobody presses on another, nor goes faster than top_speed"},
    {"social_force", "IMO 5", "who stands is pushed away by who sets out beside him"},
    {"", "NIST 2.9", "agents keep no company: none waits for another"},
};

}  // namespace

const char* by_nature(const std::string& model, const std::string& name) {
  for (const Nature& one : kNatures)
    if ((!*one.model || model == one.model) && name.starts_with(one.name)) return one.why;
  return nullptr;
}

}  // namespace throng::bench
