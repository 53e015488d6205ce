// Text from a file or a script never moves the cursor of the terminal that shows it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/Shape.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

/// Clears the screen, sets a title, reverses the reading direction; with a C1 control character as UTF-8.
constexpr const char* kHostile = "\x1b[2J\x1b]0;owned\x07\u009b31m\u202e";
constexpr const char* kSpelled = "\\x1b[2J\\x1b]0;owned\\x07\\x9b31m\\u202e";

void expectHarmless(const Ran& ran) {
    for (const auto& text : {ran.out, ran.err}) {
        for (const char c : text)
            EXPECT_FALSE(c >= 0 && c < 0x20 && c != '\n') << static_cast<int>(c) << " in " << text;
        EXPECT_EQ(text.find("\u009b"), std::string::npos) << text;
        EXPECT_EQ(text.find("\u202e"), std::string::npos) << text;
    }
}

class HostileText : public testing::Test {
protected:
    HostileText() { RecordProperty("hazard", "H10"); }
    const Desk desk_;
};

TEST_F(HostileText, InAColumnNameIsSpelledOut) {
    std::string text = std::string("time_s,") + kHostile + "_v\n";
    for (int i = 0; i < 2000; ++i) text += fmt::format("{:.6f},{}\n", i * 1e-5, i / 20 % 10 == 3 ? 5 : 0);
    const auto file = desk_.write("hostile.csv", text);
    const auto ran = desk_.run({"measure", file});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr(kSpelled));
    expectHarmless(ran);
    const auto json = desk_.run({"measure", file, "--json"});
    expectHarmless(json);
    EXPECT_EQ(jsonOf(json)["channels"][0]["name"], kHostile) << "the value is what it was";
}

TEST_F(HostileText, InARefusedTableIsSpelledOut) {
    const auto ran = desk_.run({"analyze", "calibration", desk_.write("c.csv", std::string(kHostile) + ",b\n1,2\n")});
    EXPECT_EQ(ran.code, 3) << ran.err;
    expectHarmless(ran);
}

TEST_F(HostileText, InAScriptsNameTitleAndLogIsSpelledOut) {
    desk_.protocol("evil\x1b[31m.js",
                   "protocol({ title: \"Evil \\u001b[2J\", purpose: \"\\u009b1A\" });\n"
                   "function run(p) { log(\"one \\u001b[1A\\rtwo\"); throw new Error(\"\\u001b[0m\"); }");
    const auto listed = desk_.run({"protocols"});
    EXPECT_THAT(listed.out, HasSubstr("Evil \\x1b[2J"));
    expectHarmless(listed);
    const auto ran = desk_.run({"run", "evil\x1b[31m", "--out", "out"});
    EXPECT_THAT(ran.err, HasSubstr("one \\x1b[1A\\x0dtwo"));
    expectHarmless(ran);
}

TEST_F(HostileText, ACountBeyondAnyIntegerIsShownAsItIs) {
    RecordProperty("hazard", "H9");
    desk_.protocol(
        "huge.js",
        "protocol({ title: 'Huge', parameters: { kind: { type: 'choice', value: 'a',"
        " choices: ['a', 'b', 'c'] } } });\n"
        "function run(p) { return verdict(Object.assign({ verdict: 'pass' },"
        " p.kind === 'a' ? { kind: 'variation', trials_needed: null, participants: 1e300 }"
        " : p.kind === 'b' ? { kind: 'load-safety', loads: [{ commands_refused: 1e300 }] }"
        " : { kind: 'separability', confusion: [], conditions: [{ n: 1e300, amplitude_v: {}, interval_s: {} }] })); }");
    for (const char* kind : {"a", "b", "c"}) {
        const auto shown = desk_.run({"run", "huge", "--set", fmt::format("kind={}", kind), "--out", kind}).out;
        EXPECT_THAT(shown, HasSubstr(" 1.000 × 10³⁰⁰")) << kind;
    }
}

TEST_F(HostileText, InAnArgumentIsSpelledOut) {
    expectHarmless(desk_.run({std::string("run\x1b[2J")}));
    expectHarmless(desk_.run({"run", "live", "--set", std::string("\x1b]0;x\x07=1")}));
    expectHarmless(desk_.run({"verify", std::string("no\x1b[2Jfile")}));
}

TEST(CommandLine, PrintsThroughOneFunction) {
    RecordProperty("hazard", "H10");
    for (const auto& entry : std::filesystem::directory_iterator(sourceDir() / "app" / "cli")) {
        if (entry.path().filename() == "Say.h") continue;
        const auto text = contentOf(entry.path());
        for (const char* way : {"fmt::print", "std::cout", "std::cerr", "printf(", "fputs(", "puts(", "fwrite("})
            EXPECT_EQ(text.find(way), std::string::npos) << entry.path() << " prints by " << way;
    }
}

}  // namespace
}  // namespace tacto::test
