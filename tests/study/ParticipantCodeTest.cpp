#include <gtest/gtest.h>
#include <set>

#include "core/study/Participant.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

TEST(ParticipantCode, HasTheCheckCharacterOfIso7064) {
    // The examples of MOD 37,36 in the standard, as listed by python-stdnum.
    EXPECT_EQ(checkCharacter("A12425GABC1234002"), 'M');
    EXPECT_EQ(checkCharacter("P7K3"), 'D');
    EXPECT_EQ(checkCharacter("P-7"), std::nullopt);
}

TEST(ParticipantCode, EverySlipOfOneCharacterIsFound) {
    RecordProperty("hazard", "H11");
    constexpr std::string_view kAll = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ";
    const std::string code = "P-7K3D";
    ASSERT_EQ(checkedCode(code).value(), code);
    EXPECT_EQ(checkedCode("p-7k3d").value(), code);
    for (const std::size_t at : {0UL, 2UL, 3UL, 4UL, 5UL}) {
        for (const char c : kAll) {
            if (c == code[at]) continue;
            auto slipped = code;
            slipped[at] = c;
            EXPECT_FALSE(checkedCode(slipped)) << slipped;
        }
    }
}

TEST(ParticipantCode, OneThatIsNoCodeIsRefusedInOneSentence) {
    for (const char* text : {"", "-", "P-", "P-7K3M", "P 7K3D", "P-7K3D; rm", "virtual:7"}) {
        EXPECT_THAT(checkedCode(text), test::refused(ErrorCode::NotFound)) << text;
    }
    EXPECT_EQ(
        checkedCode("P-7K3M").error().message,
        "\"P-7K3M\" is not a participant's code: its check character is wrong; a code as P-7K3D is expected, whose "
        "last character checks the others");
}

TEST(ParticipantCode, NewOnesAreCodesAndDiffer) {
    std::set<std::string> all;
    for (int i = 0; i < 200; ++i) {
        const auto code = newCode();
        EXPECT_TRUE(checkedCode(code)) << code;
        all.insert(code);
    }
    EXPECT_GT(all.size(), 150U);
}

}  // namespace
}  // namespace tacto
