#include <gtest/gtest.h>
#include <string>

#include "core/base/Ascii.h"

namespace tacto::test {
namespace {

TEST(Ascii, FoldsTheLettersAToZAndNoOtherByte) {
    const std::string small = "abcdefghijklmnopqrstuvwxyz", large = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";
    for (int code = 0; code < 256; ++code) {
        const char byte = static_cast<char>(code);
        const auto isSmall = small.find(byte), isLarge = large.find(byte);
        EXPECT_EQ(lowered(byte), isLarge == std::string::npos ? byte : small[isLarge]) << code;
        EXPECT_EQ(capital(byte), isSmall == std::string::npos ? byte : large[isSmall]) << code;
    }
    EXPECT_EQ(lowered("TIME, CH1 (V) ÄÖÜ İI"), "time, ch1 (v) ÄÖÜ İi");
    EXPECT_EQ(capitals("dışçi, 2.000v/div"), "DışçI, 2.000V/DIV");
}

TEST(Ascii, TwoTextsAreTheSameButForCapitals) {
    EXPECT_TRUE(sameLetters("Isense", "ISENSE"));
    EXPECT_TRUE(sameLetters("RIGOL DS1054Z", "Rigol ds1054z"));
    EXPECT_TRUE(sameLetters("", ""));
    EXPECT_FALSE(sameLetters("Isense", "Isens"));
    EXPECT_FALSE(sameLetters("ı", "i"));
    EXPECT_FALSE(sameLetters("[", "{")) << "what stands 32 beside another is not its capital";
}

}  // namespace
}  // namespace tacto::test
