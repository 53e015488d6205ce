#include <gtest/gtest.h>
#include <set>

#include "app/scripting/engine/HostFunction.h"
#include "app/scripting/engine/ScriptRun.h"

namespace tacto {
namespace {

TEST(HostReference, DescribesEveryFunctionAndParameter) {
    const std::string reference = scriptReference();
    for (const auto& function : hostFunctions()) {
        const std::string name = function.fullName();
        EXPECT_NE(function.call, nullptr) << name;
        EXPECT_GE(function.text.size(), 12U) << name;
        EXPECT_NE(reference.find("### `" + name), std::string::npos) << name;
        EXPECT_FALSE(function.kind == HostKind::Property && function.returns.empty()) << name;
        for (const auto& parameter : function.parameters) {
            EXPECT_FALSE(parameter.accepted().empty() || parameter.about.empty()) << name << ": " << parameter.name;
            EXPECT_NE(reference.find("- `" + std::string(parameter.name) + "`"), std::string::npos) << name;
            // A number with a physical unit in its name must say the unit.
            for (const char* suffix : {"_s", "_v", "_ma", "_hz", "_n", "_mm_s"}) {
                EXPECT_FALSE(parameter.name.ends_with(suffix) && parameter.unit.empty())
                    << name << ": " << parameter.name;
            }
            EXPECT_FALSE(parameter.name == "seconds" && parameter.unit != "s");
        }
    }
}

TEST(HostReference, NamesTheObjectsOfTheLanguageAndNothingTwice) {
    std::set<std::string> names, objects;
    for (const auto& function : hostFunctions()) {
        EXPECT_TRUE(names.insert(function.fullName()).second) << function.name;
        objects.insert(std::string(function.object));
    }
    EXPECT_EQ(objects, (std::set<std::string>{"", "bench", "operator", "analysis", "report", "random", "record",
                                              "measure", "pilot", "plot", "loads", "calibration"}));
    for (const char* global : {"protocol", "progress", "verdict", "log"}) EXPECT_TRUE(names.count(global)) << global;
}

}  // namespace
}  // namespace tacto
