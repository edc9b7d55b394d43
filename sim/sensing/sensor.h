// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <vector>

/// What bodies and agents sense of each other, as a scene asks for it; `Sensing` finds it.
namespace throng {

/// What nobody is sensed through: where the line from centre to centre touches it.
enum class Screens : std::uint8_t { none, walls, bodies };  // bodies: and walls
inline constexpr std::array kScreens{"none", "walls", "bodies"};
constexpr const char* name(Screens screens) {
  return kScreens[static_cast<std::size_t>(screens)];
}

struct Sensor {
  std::string name;
  std::vector<std::uint32_t> ids;  ///< of those who have it, ascending; empty: all
  double radius = 0.0;             ///< m, from centre to centre, the end included
  double fov = 360.0;              ///< degrees, the whole view; see `heading`
  Screens screens = Screens::none;
  int every = 1;        ///< steps from one look to the next; the first is at step 0
  bool record = false;  ///< into the recording, each time
};
inline constexpr std::size_t kMostSensors = 8;

/// Those that are recorded, in their order.
inline std::vector<Sensor> recorded(std::span<const Sensor> sensors) {
  std::vector<Sensor> result;
  std::ranges::copy_if(sensors, std::back_inserter(result), &Sensor::record);
  return result;
}

/// Who senses whom at one step, as compressed rows.
struct Sensed {
  std::vector<std::uint32_t> who;    ///< ids of those who have the sensor and are there, ascending
  std::vector<std::uint32_t> count;  ///< how many each of them senses
  std::vector<std::uint32_t> whom;   ///< their ids, of one after the other, ascending in each

  void clear() { who.clear(), count.clear(), whom.clear(); }
  friend bool operator==(const Sensed&, const Sensed&) = default;
};

/// What a sensor has sensed so far.
struct SensedSum {
  std::int64_t looks = 0;   ///< of all who have it
  std::int64_t sensed = 0;  ///< whom they sensed, over all looks

  friend bool operator==(const SensedSum&, const SensedSum&) = default;
};

}  // namespace throng
