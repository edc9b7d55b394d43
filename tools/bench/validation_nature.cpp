// SPDX-License-Identifier: MIT
#include <string_view>

#include "tools/bench/validation_cases.h"

namespace throng::bench {

namespace {

struct Nature {
  const char *model, *name, *why;  ///< `name`: how the case's begins; either empty: any
};

constexpr const char* kEvenCrowd =
    "pushes from ahead and from behind cancel in an even crowd: nobody slows down (Parisi and others 2009)";
constexpr const char* kAlike = "who all walk alike are in nobody's way, however near: nobody slows down";
constexpr const char* kNoGap =
    "nobody keeps a distance: a door lets through as many as fit beside one another";
constexpr const char* kCarried =
    "who is slow is pushed on by those behind him, faster than he wants: he holds up nobody";

constexpr Nature kNatures[] = {
    {"constant_velocity", "", "agents see nobody"},
    {"collision_free_speed", "faster is slower", "nobody presses on another"},
    {"orca", "faster is slower", "nobody presses on another, nor goes faster than top_speed"},
    {"social_force", "IMO 5", "who stands is pushed away by who sets out beside him"},
    {"social_force", "Weidmann", kEvenCrowd},
    {"social_force", "RiMEA 16", kEvenCrowd},
    {"social_force", "NIST 2.10", kCarried},
    {"orca", "NIST 2.10", kCarried},
    {"orca", "Weidmann", kAlike},
    {"orca", "RiMEA 16", kAlike},
    {"orca", "IMO 4", kNoGap},
    {"orca", "Seyfried 2009: flow through", kNoGap},
    {"", "RiMEA 15",
     "all take the shortest way, which cuts the corner: the corridor's other half stays empty"},
    {"", "NIST 2.9", "agents keep no company: none waits for another"},
};

}  // namespace

const char* by_nature(const std::string& model, const std::string& name) {
  for (const Nature& one : kNatures)
    if ((!*one.model || model == one.model) && name.starts_with(one.name)) return one.why;
  return nullptr;
}

}  // namespace throng::bench
