// Markers from the command line: what is refused before anything begins, and what a recorder receives.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/PilotDesk.h"
#include "tests/support/MarkerRecorder.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

TEST(PilotMarkers, APortThatCannotBeHadBeginsNothing) {
    const PilotDesk desk;
    const HeldPort held;
    const auto taken = std::to_string(held.port());
    const std::tuple<std::string, int, std::string> wrong[] = {
        {"x", 2, "\"x\""},
        {"80", 2, "1024 to 65535"},
        {"65536", 2, "\"65536\""},
        {"", 2, "\"\""},
        {"nohost:5005", 2, "nohost:5005"},
        {taken, 3, "another program has that port"},
        {"192.0.2.7:" + taken, 3, "an address of this computer"}};
    for (const auto& [given, code, says] : wrong) {
        const auto ran = desk.run("pilot-identification", shortSession() + Words{"--markers", given});
        EXPECT_EQ(ran.code, code) << given;
        EXPECT_THAT(ran.err, HasSubstr(says));
        EXPECT_EQ(std::ranges::count(ran.err, '\n'), 1) << ran.err;
        EXPECT_EQ(ran.out, "");
        EXPECT_FALSE(std::filesystem::exists(desk.desk().at("study"))) << given;
    }
    const auto other = desk.desk().run({"run", "separability", "--device", "sim:", "--markers", "5005"});
    EXPECT_EQ(other.code, 2);
    EXPECT_THAT(other.err, HasSubstr("only pilot sessions send markers"));
}

TEST(PilotMarkers, ASessionIsTheSameWithAndWithoutThem) {
    const PilotDesk desk;
    const auto plain = desk.run("pilot-identification", shortSession());
    ASSERT_EQ(plain.code, 0) << plain.err;
    EXPECT_TRUE(jsonOf(plain)["markers"].is_null());
    const auto port = freePort();
    const MarkerRecorder recorder(port);
    const auto marked =
        desk.run("pilot-identification", shortSession() + Words{"--markers", std::to_string(port)}, "marked");
    ASSERT_EQ(marked.code, 0) << marked.err;
    EXPECT_EQ(planAndAnswers(jsonOf(marked)), planAndAnswers(jsonOf(plain)));
    const auto tally = jsonOf(marked)["markers"];
    EXPECT_GT(tally["made"].get<int>(), 100);
    EXPECT_EQ(tally["recorders"], 1);
    EXPECT_EQ(tally["lost"], 0);
    EXPECT_THAT(marked.err, HasSubstr("markers were made"));
    for (int i = 0; i < 2000 && !recorder.ended(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const auto lines = recorder.lines();
    ASSERT_EQ(lines.size(), tally["made"].get<std::size_t>() - tally["unheard"].get<std::size_t>() + 1);
    EXPECT_TRUE(lines.back().ends_with(" session-end")) << lines.back();
    EXPECT_EQ(desk.desk().run({"verify", desk.desk().at("marked")}).code, 0);
}

TEST(PilotMarkers, KilledAndResumedWithThemIsAsUndisturbed) {
    RecordProperty("hazard", "H8");
    const PilotDesk desk;
    const auto plain = desk.run("pilot-identification", shortSession());
    ASSERT_EQ(plain.code, 0) << plain.err;
    const auto words = shortSession() + Words{"--markers", std::to_string(freePort())};
    ASSERT_EQ(desk.runKilled(200, "pilot-identification", words, "killed"), -9);
    const auto resumed = desk.run("pilot-identification", words + Words{"--set", "unfinished=resume"}, "killed");
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_EQ(planAndAnswers(jsonOf(resumed)), planAndAnswers(jsonOf(plain)));
    EXPECT_EQ(jsonOf(resumed)["markers"]["recorders"], 0);
}

}  // namespace
}  // namespace tacto::test
