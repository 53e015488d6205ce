// analyze identification: answers from a CSV, against the figures of tests/reference/identification.py.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/Shape.h"
#include "tests/support/Figures.h"

namespace tacto::test {
namespace {

TEST(AnalyzeIdentification, AgreesWithTheSecondComputation) {
    const auto& session = figuresOf("identification").at("session");
    std::string text = "block,stimulus,response\n";
    for (const auto& trial : session.at("trials")) {
        text += std::to_string(trial.at("block").get<int>()) + "," + trial.at("condition").get<std::string>() + "," +
                trial.at("response").get<std::string>() + "\n";
    }
    const Desk desk;
    const auto ran = desk.run({"analyze", "identification", desk.write("answers.csv", text), "--json"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    const auto found = jsonOf(ran);
    EXPECT_EQ(found.at("n"), session.at("n"));
    EXPECT_EQ(found.at("hits"), session.at("hits"));
    EXPECT_NEAR(found.at("accuracy").at("low").get<double>(), session.at("accuracy").at("low").get<double>(), 1e-9);
    EXPECT_NEAR(found.at("it_bits").get<double>(), session.at("it_bits").get<double>(), 1e-9);
    EXPECT_NEAR(found.at("it_bias_bits").get<double>(), session.at("it_bias_bits").get<double>(), 1e-9);
    EXPECT_NEAR(found.at("texture").at("it_bits").get<double>(), session.at("texture").at("it_bits").get<double>(),
                1e-9);
    EXPECT_EQ(found.at("catch").at("false_alarms"), session.at("catch").at("k"));
}

TEST(AnalyzeIdentification, PeopleAreNotPooled) {
    std::string text = "participant,stimulus,response\n";
    for (const char* who : {"A", "B", "C"}) {
        for (int i = 0; i < 20; ++i) text += std::string(who) + (i % 2 == 0 ? ",x,x\n" : ",y,y\n");
    }
    const Desk desk;
    const auto file = desk.write("answers.csv", text);
    const auto found = jsonOf(desk.run({"analyze", "identification", file, "--json"}));
    EXPECT_FALSE(found.contains("p_chance"));
    EXPECT_EQ(found.at("people").size(), 3U);
    EXPECT_EQ(found.at("above_chance").at("k"), 3);
    EXPECT_NEAR(found.at("above_chance").at("prevalence_at_least").get<double>(), 0.45, 0.005);
    const auto said = desk.run({"analyze", "identification", file});
    EXPECT_NE(said.out.find("3 of 3 were above chance"), std::string::npos) << said.out;
    EXPECT_NE(said.out.find("at least 45 %"), std::string::npos) << said.out;
}

TEST(AnalyzeIdentification, RefusesWhatIsNoTableOfAnswers) {
    const Desk desk;
    expectRefused(desk.run({"analyze", "identification", desk.write("a.csv", "stimulus\nx\n")}), 3,
                  {"columns stimulus and response were expected"});
    expectRefused(desk.run({"analyze", "identification", desk.write("b.csv", "stimulus,response\nx,x\n")}), 3,
                  {"b.csv", "at least two are needed"});
}

}  // namespace
}  // namespace tacto::test
