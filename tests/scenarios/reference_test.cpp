// SPDX-License-Identifier: MIT
#include "scenarios/reference.h"

#include <gmock/gmock.h>

#include "scenarios/grammar.h"

namespace throng::scenarios {
namespace {

using ::testing::HasSubstr;

TEST(Reference, TellsOfAFieldItsMeaningItsRangeAndItsPreset) {
  const std::string text = reference();
  EXPECT_THAT(text, HasSubstr("materials.NAME.density            Mass per area, kg/m^2.\n"));
  EXPECT_THAT(text, HasSubstr("a number from 1e-09 to 1e+12 kg/m^2; 1.0 when absent\n"));
  EXPECT_THAT(text, HasSubstr("shapes.NAME.disc.radius.uniform "));
  EXPECT_THAT(text, HasSubstr("bodies[].shape                    Name of a shape. Required.\n"));
  EXPECT_THAT(text, HasSubstr("round this box, m. Just one of box, periodic.\n"));
}

TEST(Reference, HasEveryFieldThatMayStandAtTheRootAndNoneThatIsToCome) {
  const std::string text = reference();
  for (const Field& field : grammar().fields)
    EXPECT_EQ(text.find("\n" + field.key + " ") != std::string::npos, !field.later) << field.key;
}

}  // namespace
}  // namespace throng::scenarios
