#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/seal/Passphrase.h"
#include "core/seal/SealedText.h"
#include "core/study/Study.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

TEST(SealedText, OpensWithItsKeyInItsPlaceOnly) {
    RecordProperty("hazard", "H11");
    const auto key = Secret::random(kKeyBytes);
    const auto sealed = sealText(key, "study\nsession\n7\nevent", "rough-high");
    EXPECT_EQ(openText(key, "study\nsession\n7\nevent", sealed).value(), "rough-high");
    EXPECT_FALSE(openText(key, "study\nsession\n8\nevent", sealed));
    EXPECT_FALSE(openText(Secret::random(kKeyBytes), "study\nsession\n7\nevent", sealed));
    EXPECT_NE(sealText(key, "study\nsession\n7\nevent", "rough-high"), sealed);
}

TEST(SealedText, HidesTheLengthToABlock) {
    const auto key = Secret::random(kKeyBytes);
    EXPECT_EQ(sealText(key, "", "none").size(), sealText(key, "", std::string(255, 'x')).size());
    EXPECT_LT(sealText(key, "", std::string(255, 'x')).size(), sealText(key, "", std::string(256, 'x')).size());
    EXPECT_EQ(openText(key, "", sealText(key, "", "")).value(), "");
}

TEST(SealedText, EveryFlippedBitIsFound) {
    const auto key = Secret::random(kKeyBytes);
    const std::span<const std::byte> parts[] = {std::as_bytes(std::span(std::string_view("seven")))};
    const auto sealed = sealBytes(key, "place", kTextBlock, parts);
    for (std::size_t bit = 0; bit < sealed.size() * 8; bit += 7) {
        auto altered = sealed;
        altered[bit / 8] ^= std::byte(1 << (bit % 8));
        EXPECT_FALSE(openBytes(key, "place", kTextBlock, altered)) << "bit " << bit;
    }
    for (const std::size_t size : {0UL, 1UL, 40UL, sealed.size() - 1})
        EXPECT_FALSE(openBytes(key, "place", kTextBlock, std::span(sealed).first(size))) << size;
}

TEST(SealedText, SubkeysDifferByNumber) {
    const auto key = Secret::random(kKeyBytes);
    const auto sealed = sealText(subkey(key, 1), "", "x");
    EXPECT_TRUE(openText(subkey(key, 1), "", sealed));
    EXPECT_FALSE(openText(subkey(key, 2), "", sealed));
}

TEST(Passphrase, MakesTheSameKeyFromTheSameSaltOnly) {
    const auto words = Passphrase::from("a passphrase").value();
    const auto salt = Secret::random(Passphrase::kSaltBytes);
    const auto one = words.keyFor(salt.bytes(), PassphraseCost::least()).value();
    EXPECT_TRUE(std::ranges::equal(one.bytes(), words.keyFor(salt.bytes(), PassphraseCost::least())->bytes()));
    const auto other = Secret::random(Passphrase::kSaltBytes);
    EXPECT_FALSE(std::ranges::equal(one.bytes(), words.keyFor(other.bytes(), PassphraseCost::least())->bytes()));
    EXPECT_FALSE(Passphrase::from(""));
    EXPECT_GT(PassphraseCost::moderate().bytes(), 200'000'000U);
    EXPECT_EQ(Study::Surroundings().cost.bytes(), PassphraseCost::moderate().bytes());
    EXPECT_EQ(Study::Surroundings().cost.passes(), PassphraseCost::moderate().passes());
}

TEST(Passphrase, IsTheFirstLineOfItsFile) {
    const test::ScratchDir dir;
    const auto salt = Secret::random(Passphrase::kSaltBytes);
    const auto keyOf = [&](const Result<Passphrase>& words) {
        const auto key = words->keyFor(salt.bytes(), PassphraseCost::least());
        return std::vector<std::byte>(key->bytes().begin(), key->bytes().end());
    };
    const auto fromFile = Passphrase::fromFile(dir.write("p", "two words\r\nmore"));
    ASSERT_TRUE(fromFile);
    EXPECT_EQ(keyOf(fromFile), keyOf(Passphrase::from("two words")));
    EXPECT_EQ(Passphrase::fromFile(dir.write("empty", "\n")).error().code, ErrorCode::NotFound);
    EXPECT_EQ(Passphrase::fromFile(dir.path() / "absent").error().code, ErrorCode::NotFound);
}

TEST(Passphrase, AFileThatOthersMayReadIsRefused) {
    RecordProperty("hazard", "H11");
    const test::ScratchDir dir;
    const auto file = dir.write("p", "two words");
    for (unsigned others = 0; others <= 077; ++others) {
        SCOPED_TRACE(others);
        ASSERT_EQ(::chmod(file.c_str(), 0600 | others), 0);
        const auto read = Passphrase::fromFile(file);
        ASSERT_EQ(read.has_value(), others == 0);
        if (read) continue;
        EXPECT_EQ(read.error().code, ErrorCode::NotFound);
        EXPECT_NE(
            read.error().message.find(fmt::format("(mode {:04o}); mode 0600 is expected: chmod 600 ", 0600 | others)),
            std::string::npos)
            << read.error().message;
    }
    ASSERT_EQ(::chmod(file.c_str(), 0400), 0);
    EXPECT_TRUE(Passphrase::fromFile(file));
    const auto link = dir.path() / "link";
    std::filesystem::create_symlink(file, link);
    ASSERT_EQ(::chmod(file.c_str(), 0644), 0);
    EXPECT_FALSE(Passphrase::fromFile(link)) << "what a link names counts";
    if (::geteuid() != 0) return;
    constexpr ::uid_t kOther = 65'534;
    ASSERT_EQ(::chmod(file.c_str(), 0600), 0);
    ASSERT_EQ(::chown(file.c_str(), kOther, kOther), 0);
    EXPECT_FALSE(Passphrase::fromFile(file)) << "its owner may read it";
}

TEST(Secret, SwitchesCoreDumpsOff) {
    RecordProperty("hazard", "H11");
    const Secret held(1);
    ::rlimit limit{};
    ASSERT_EQ(::getrlimit(RLIMIT_CORE, &limit), 0);
    EXPECT_EQ(limit.rlim_cur, 0U);
    EXPECT_EQ(limit.rlim_max, 0U);
}

}  // namespace
}  // namespace tacto
