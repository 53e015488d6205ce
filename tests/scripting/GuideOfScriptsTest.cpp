// Tests the guide's page on scripts: every example runs, and every function that a laboratory's script may need is
// described.
#include <fstream>
#include <gtest/gtest.h>
#include <map>

#include "app/scripting/engine/HostFunction.h"
#include "app/scripting/engine/Operator.h"
#include "core/base/Csv.h"
#include "tests/scripting/RunBench.h"

namespace tacto::test {
namespace {

const auto kPage = sourceDir() / "resources" / "help" / "guide" / "scripts.md";

/// Returns the text that is indented by four blanks, by the heading above it.
std::map<std::string, std::string> examples() {
    std::map<std::string, std::string> found;
    std::ifstream page(kPage);
    std::string heading;
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("#")) heading = line;
        if (line.starts_with("    ")) found[heading] += line.substr(4) + "\n";
    }
    return found;
}

TEST(GuideOfScripts, EachExampleRuns) {
    const auto all = examples();
    EXPECT_GE(all.size(), 9U);
    for (const auto& [heading, example] : all) {
        RunBench rig(true, "sim:", 1, true);
        auto request = rig.request(withRun(example));
        PresetOperator desk({{"dry", "yes"}, {"probe", "x10"}, {"room", "21"}});
        request.operatorDesk = &desk;
        const auto outcome = runProtocol(std::move(request)).value();
        EXPECT_FALSE(outcome.error) << heading << ": " << outcome.error->message;
        EXPECT_TRUE(rig.outputOff()) << heading;
    }
}

TEST(GuideOfScripts, NamesEveryFunctionThatIsNoStepOfAShippedProtocol) {
    const auto text = readTextFile(kPage).value();
    for (const auto& function : hostFunctions()) {
        const auto name = function.fullName();
        const bool isStep = function.object == "pilot" || function.object.find('.') != std::string_view::npos;
        if (isStep) continue;
        EXPECT_NE(text.find(name + (function.kind == HostKind::Property ? "" : "(")), std::string::npos) << name;
    }
}

}  // namespace
}  // namespace tacto::test
