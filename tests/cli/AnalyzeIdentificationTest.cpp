// analyze identification: answers from a CSV, compared with the results of tests/reference/identification.py.
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/cli/Shape.h"
#include "tests/support/Figures.h"
#include "tests/support/Trials.h"

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
    for (const char* key : {"it_bias_bits", "it_corrected_bits", "it_corrected_low_bits", "it_corrected_high_bits"})
        EXPECT_NEAR(found.at(key).get<double>(), session.at(key).get<double>(), 1e-9) << key;
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

// pilot.md section 7: if all answers are right, the corrected information is the maximum.
TEST(AnalyzeIdentification, AllRightOf90IsTwoBitsAndTheTextSaysWhatTheJsonSays) {
    RecordProperty("hazard", "H9");
    std::string text = "stimulus,response\n";
    for (int i = 0; i < 88; ++i)
        text += std::string(1, static_cast<char>('a' + i % 4)) + ',' + static_cast<char>('a' + i % 4) + '\n';
    const Desk desk;
    const auto file = desk.write("answers.csv", text);
    const auto found = jsonOf(desk.run({"analyze", "identification", file, "--json"}));
    EXPECT_NEAR(found.at("it_corrected_bits").get<double>(), 2, 1e-9);
    EXPECT_NEAR(found.at("it_bias_bits").get<double>(), 0, 1e-9);
    const auto low = fmt::format("{:.2f}", found.at("it_corrected_low_bits").get<double>());
    const auto said = desk.run({"analyze", "identification", file});
    EXPECT_NE(said.out.find("2.00 (" + low + " to 2.00) bit without what chance adds"), std::string::npos) << said.out;
}

TEST(AnalyzeIdentification, APersonWithOneTrialIsNamedAndLeftOut) {
    RecordProperty("hazard", "H9");
    std::string text = "participant,stimulus,response\n";
    for (const char* who : {"A", "C"}) {
        for (int i = 0; i < 20; ++i) text += std::string(who) + (i % 2 == 0 ? ",x,x\n" : ",y,y\n");
    }
    text += "B,x,x\n";
    for (int i = 0; i < 2; ++i) text += "D,none,x\nD,y,y\n";  // no condition can have the name "none"
    const Desk desk;
    const auto file = desk.write("answers.csv", text);
    const auto ran = desk.run({"analyze", "identification", file, "--json"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    const auto found = jsonOf(ran);
    ASSERT_EQ(found.at("people").size(), 2U);
    EXPECT_EQ(found.at("people")[1].at("name"), "C");
    EXPECT_EQ(found.at("people")[1].at("n"), 20);
    EXPECT_EQ(found.at("above_chance").at("n"), 2);
    ASSERT_EQ(found.at("left_out").size(), 2U);
    EXPECT_EQ(found.at("left_out")[0].at("name"), "B");
    EXPECT_NE(found.at("left_out")[0].at("reason").get<std::string>().find("at least two are needed"),
              std::string::npos);
    const auto said = desk.run({"analyze", "identification", file});
    EXPECT_EQ(said.code, 0) << said.err;
    EXPECT_NE(said.out.find("2 of 4 participants were left out: B: 1 condition(s)"), std::string::npos) << said.out;
    EXPECT_NE(said.out.find("2 of 2 were above chance"), std::string::npos) << said.out;
    expectRefused(desk.run({"analyze", "identification",
                            desk.write("single.csv", "participant,stimulus,response\nA,x,x\nB,y,y\n")}),
                  3, {"single.csv", "no participant can be analysed", "A: 1 condition(s)", "B: "});
}

std::string answersTable(std::initializer_list<std::pair<const char*, const char*>> whoAndBasis, bool says = true) {
    std::string text = says ? "participant,basis,stimulus,response\n" : "participant,stimulus,response\n";
    for (const auto& [who, basis] : whoAndBasis) {
        for (int i = 0; i < 20; ++i) {
            text += std::string(who) + (says ? std::string(",") + basis : std::string()) +
                    (i % 2 == 0 ? ",x,x\n" : ",y,y\n");
        }
    }
    return text;
}

// A table that does not say whether its rows are people is not reported as people.
TEST(AnalyzeIdentification, SpeaksOfPeopleOnlyWhereTheTableTheOptionOrTheExportSaysSo) {
    RecordProperty("hazard", "H8");
    const Desk desk;
    struct Case {
        const char* word;
        const char* who;  ///< the end of "of such ... can tell them apart"
        const char* name;
    };
    for (const auto& [word, who, name] :
         {Case{"person", "people", "B told"},
          {"person on simulated devices", "people on simulated devices", "B (simulated devices) told"},
          {"virtual participant", "virtual participants", "B (virtual) told"},
          {"", "participants", "B told"}}) {
        SCOPED_TRACE(word);
        const std::string basis = word;
        const auto file = desk.write("says.csv", answersTable({{"A", word}, {"B", word}, {"C", word}}));
        const auto silent = desk.write("silent.csv", answersTable({{"A", ""}, {"B", ""}, {"C", ""}}, false));
        const auto exported = desk.write("export.tsv", answersTable({{"A", ""}, {"B", ""}, {"C", ""}}, false));
        desk.write("export.json", basis.empty() ? "{}" : fmt::format(R"({{"Basis": "{}"}})", word));
        std::vector<std::vector<std::string>> calls{{file}, {exported}};
        if (basis.empty())
            calls.push_back({silent});
        else
            calls.push_back({silent, "--basis", basis});
        for (const auto& call : calls) {
            std::vector<std::string> words{"analyze", "identification"};
            words.insert(words.end(), call.begin(), call.end());
            const auto said = desk.run(words);
            EXPECT_EQ(said.code, 0) << said.err;
            EXPECT_NE(said.out.find(fmt::format("of such {} can tell them apart", who)), std::string::npos) << said.out;
            EXPECT_NE(said.out.find(name), std::string::npos) << said.out;
            EXPECT_EQ(said.out.find("On whom this rests is not known") != std::string::npos, basis.empty()) << said.out;
            words.emplace_back("--json");
            const auto found = jsonOf(desk.run(words));
            EXPECT_EQ(found.at("basis"), basis.empty() ? nlohmann::json() : nlohmann::json(basis));
        }
    }
    const auto one = desk.run({"analyze", "identification", desk.write("one.csv", answersTable({{"A", ""}}, false))});
    EXPECT_NE(one.out.find("rests on     not known"), std::string::npos) << one.out;
}

TEST(AnalyzeIdentification, NoFigureIsOfTwoKinds) {
    RecordProperty("hazard", "H8");
    const Desk desk;
    const auto mixed = desk.write("mixed.csv", answersTable({{"A", "person"}, {"B", "virtual participant"}}));
    expectRefused(desk.run({"analyze", "identification", mixed}), 3,
                  {"mixed.csv", "rest on a person and on a virtual participant"});
    const auto partly = desk.write("partly.csv", answersTable({{"A", "person"}, {"B", "n/a"}}));
    expectRefused(desk.run({"analyze", "identification", partly}), 3, {"participant \"B\" is not stated"});
    const auto twice = desk.write("twice.csv", answersTable({{"A", "person"}, {"A", "virtual participant"}}));
    expectRefused(desk.run({"analyze", "identification", twice}), 3, {"one for each participant was expected"});
    const auto person = desk.write("person.csv", answersTable({{"A", "person"}, {"B", "person"}}));
    expectRefused(desk.run({"analyze", "identification", person, "--basis", "virtual participant"}), 3,
                  {"rest on a virtual participant and on a person"});
    expectRefused(desk.run({"analyze", "identification", person, "--basis", "robot"}), 2, {"\"robot\"", "is expected"});
    expectRefused(desk.run({"analyze", "separability", person, "--basis", "person"}), 2, {"takes no --basis"});
}

TEST(AnalyzeIdentification, RefusesWhatIsNoTableOfAnswers) {
    const Desk desk;
    expectRefused(desk.run({"analyze", "identification", desk.write("a.csv", "stimulus\nx\n")}), 3,
                  {"columns stimulus and response were expected"});
    expectRefused(desk.run({"analyze", "identification", desk.write("b.csv", "stimulus,response\nx,x\n")}), 3,
                  {"b.csv", "at least two are needed"});
}

// Sessions and encodings of a table: which encoding is better, within person, counted by hand.
TEST(AnalyzeIdentification, EncodingsAreComparedWithinPersonOverAllSessions) {
    RecordProperty("hazard", "H9");
    std::mt19937 random(49);
    const Desk desk;
    const int rounds = trials<int>({.local = 3, .ci = 10, .campaign = 100});
    for (int round = 0; round < rounds; ++round) {
        std::string text = "participant,session,encoding,trial,block,stimulus,response\n";
        const int people = 2 + int(random() % 4);
        double sum = 0, squares = 0;
        for (int who = 0; who < people; ++who) {
            double right[2] = {0, 0}, n[2] = {0, 0};
            for (int session = 0; session < 4; ++session) {
                const int which = (session + who) % 2;
                for (int trial = 1; trial <= 24; ++trial) {
                    const char asked = char('a' + trial % 4);
                    const bool hit = random() % 100 < (which == 1 ? 80U : 55U);
                    right[which] += hit ? 1 : 0;
                    n[which] += 1;
                    text += fmt::format("{},{},{},{},1,{},{}\n", who, session, which == 1 ? "swapped" : "standard",
                                        trial, asked, hit ? asked : char('a' + (trial + 1) % 4));
                }
            }
            const double difference = 100 * (right[1] / n[1] - right[0] / n[0]);
            sum += difference;
            squares += difference * difference;
        }
        const auto file = desk.write("answers.csv", text);
        const auto ran = desk.run({"analyze", "identification", file, "--json"});
        ASSERT_EQ(ran.code, 0) << ran.err;
        const auto found = jsonOf(ran);
        const auto& rows = found.at("differences");
        ASSERT_EQ(rows.size(), std::size_t(people) + 1);
        const auto& mean = rows.back();
        EXPECT_EQ(mean.at("of"), "swapped minus standard");
        EXPECT_NEAR(mean.at("points").at("value").get<double>(), sum / people, 1e-9);
        // Never narrower than the spread of the people makes it: t is at least 1.96.
        const double error = std::sqrt(std::max(0.0, squares - sum * sum / people) / (people - 1) / people);
        EXPECT_LE(mean.at("points").at("low").get<double>(), sum / people - 1.96 * error + 1e-9);
        EXPECT_EQ(found.at("encodings").size(), 2 * std::size_t(people));
        EXPECT_EQ(found.at("people").at(0).at("n"), 96);
        const auto said = desk.run({"analyze", "identification", file});
        EXPECT_NE(said.out.find("swapped"), std::string::npos);
        EXPECT_NE(said.out.find(fmt::format("{} degrees of freedom", people - 1)), std::string::npos) << said.out;
    }
}

}  // namespace
}  // namespace tacto::test
