#include <gtest/gtest.h>

#include "app/scripting/engine/Operator.h"

namespace tacto {
namespace {

using Kind = OperatorQuestion::Kind;

OperatorQuestion question(Kind kind) {
    OperatorQuestion out;
    out.kind = kind;
    out.name = "wiring";
    out.text = "Check the wiring";
    return out;
}

Result<nlohmann::json> answerOf(std::map<std::string, std::string> answers, const OperatorQuestion& asked) {
    return PresetOperator(std::move(answers)).ask(asked);
}

TEST(PresetOperator, NamesTheMissingAnswer) {
    PresetOperator absent({});
    const auto answer = absent.ask(question(Kind::Confirm));
    EXPECT_EQ(answer.error().message,
              "\"Check the wiring\" needs an answer, and this run has no operator to ask: give --set wiring=...");
    EXPECT_EQ(answer.error().code, ErrorCode::NotFound);
}

TEST(PresetOperator, ConfirmsOrEndsTheRun) {
    EXPECT_EQ(answerOf({{"wiring", "yes"}}, question(Kind::Confirm)).value(), true);
    EXPECT_EQ(answerOf({{"wiring", "no"}}, question(Kind::Confirm)).error().code, ErrorCode::Stopped);
    EXPECT_EQ(answerOf({{"wiring", "maybe"}}, question(Kind::Confirm)).error().code, ErrorCode::InvalidArgument);
}

TEST(PresetOperator, ChoosesAmongTheChoicesOnly) {
    auto choice = question(Kind::Choose);
    choice.choices = {{"left", "left hand"}, {"right", "right hand"}};
    EXPECT_EQ(answerOf({{"wiring", "left"}}, choice).value(), "left");
    EXPECT_EQ(answerOf({{"wiring", "foot"}}, choice).error().message,
              "wiring=foot does not answer \"Check the wiring\"; one of left, right is expected");
}

TEST(PresetOperator, EntersNumbersWithinTheirRange) {
    auto number = question(Kind::Enter);
    number.number = true;
    number.min = 0;
    number.max = 50;
    number.unit = "C";
    EXPECT_EQ(answerOf({{"wiring", "21.5"}}, number).value(), 21.5);
    for (const char* bad : {"51", "-1", "nan", "inf", "warm", ""}) {
        EXPECT_EQ(answerOf({{"wiring", bad}}, number).error().code, ErrorCode::InvalidArgument) << bad;
    }
    number.number = false;
    EXPECT_EQ(answerOf({{"wiring", "warm"}}, number).value(), "warm");
}

}  // namespace
}  // namespace tacto
