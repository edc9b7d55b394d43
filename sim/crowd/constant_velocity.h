// SPDX-License-Identifier: MIT
#pragma once

#include "sim/crowd/model.h"

namespace throng {

/// Everyone walks his way at his desired speed and looks at nobody: the measure of an empty floor.
ModelKind constant_velocity();

}  // namespace throng
