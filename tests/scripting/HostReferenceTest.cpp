#include <filesystem>
#include <gtest/gtest.h>
#include <regex>
#include <set>

#include "app/scripting/engine/HostFunction.h"
#include "app/scripting/engine/ScriptRun.h"
#include "core/base/Csv.h"
#include "tests/support/Support.h"

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

/// Returns the words of a description that can only be keys of the result, such as "load_ohm".
std::set<std::string> keysIn(std::string_view description) {
    static const std::regex key(R"(\b[a-z][a-z0-9]*(?:_[a-z0-9]+)+\b)");
    const std::string text(description);
    std::set<std::string> keys;
    for (std::sregex_iterator at(text.begin(), text.end(), key), end; at != end; ++at) keys.insert(at->str());
    return keys;
}

TEST(HostReference, NamesNoKeyThatNothingWrites) {
    std::string sources;
    for (const char* folder : {"app/scripting", "core"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(test::sourceDir() / folder)) {
            const auto ending = entry.path().extension();
            if (ending == ".cpp" || ending == ".h") sources += readTextFile(entry.path()).value();
        }
    }
    std::size_t keys = 0;
    for (const auto& function : hostFunctions()) {
        for (const auto& key : keysIn(function.returns)) {
            ++keys;
            EXPECT_NE(sources.find('"' + key + '"'), std::string::npos) << function.fullName() << " returns " << key;
        }
    }
    EXPECT_GT(keys, 40U);  // others come from the description of the record
    EXPECT_EQ(keysIn("{ a, load_ohm, x_1 }: _u_ is one"), (std::set<std::string>{"load_ohm", "x_1"}));
}

TEST(HostReference, NamesTheObjectsOfTheLanguageAndNothingTwice) {
    std::set<std::string> names, objects;
    for (const auto& function : hostFunctions()) {
        EXPECT_TRUE(names.insert(function.fullName()).second) << function.name;
        objects.insert(std::string(function.object));
    }
    EXPECT_EQ(objects, (std::set<std::string>{"", "bench", "operator", "analysis", "report", "random", "record",
                                              "measure", "pilot", "plot", "bench.loadSafety",
                                              "bench.stimulatorCalibration", "bench.sensorCalibration",
                                              "bench.transitions", "bench.encodingComparison", "bench.variation"}));
    for (const char* global : {"protocol", "progress", "verdict", "log"}) EXPECT_TRUE(names.count(global)) << global;
}

}  // namespace
}  // namespace tacto
