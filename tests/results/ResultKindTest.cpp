// What is declared of each kind of result.
#include <gtest/gtest.h>

#include "core/results/ResultKind.h"

namespace tacto {
namespace {

TEST(ResultKinds, AreFoundByTheirNames) {
    EXPECT_EQ(resultTraits("separability").kind, ResultKind::Separability);
    EXPECT_TRUE(resultTraits("load-safety").guardBanded);
    EXPECT_FALSE(resultTraits("sensor-calibration").guardBanded);
}

TEST(ResultKinds, OfALaboratorysOwnDeclareNothing) {
    for (const char* name : {"", "separability2", "Live", "my-kind"}) {
        const auto& traits = resultTraits(name);
        EXPECT_EQ(traits.kind, ResultKind::Other) << name;
        EXPECT_EQ(traits.decisionRule, "");
        EXPECT_FALSE(traits.guardBanded);
        EXPECT_TRUE(traits.tables.empty());
    }
}

}  // namespace
}  // namespace tacto
