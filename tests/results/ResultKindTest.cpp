// The facts declared for each kind of result.
#include <gtest/gtest.h>

#include "core/kinds/ResultKinds.h"

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

TEST(ResultTables, ARecordHasTheUnitOfWhatItIsAPartOf) {
    const nlohmann::json found = {
        {"gap", {{"unit", "s"}, {"budget", {{"rows", {{{"name", "a"}}, {{"name", "b"}, {"unit", "V"}}}}}}}}};
    const auto rows = rowsOf({.at = "gap.budget.rows"}, found);
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0]["unit"], "s");
    EXPECT_EQ(rows[1]["unit"], "V");
    const auto parts = rowsOf({.at = "|gap"}, found);
    EXPECT_EQ(parts[0]["of"], "all");
    EXPECT_EQ(parts[1]["of"], "gap");
    EXPECT_EQ(rowsOf({.at = "gap.budget.rows", .where = "name", .is = "b"}, found).size(), 1U);
}

}  // namespace
}  // namespace tacto
