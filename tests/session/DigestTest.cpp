#include <cstring>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/session/Digest.h"
#include "tests/support/Figures.h"

namespace tacto {
namespace {

std::span<const std::byte> bytes(std::string_view text) { return std::as_bytes(std::span(text)); }

// Compared with Python's hashlib and zlib (tests/reference/digests.py).
TEST(Digest, Sha256IsHashlibs) {
    for (const auto& [text, digest] : test::figuresOf("digests").at("sha256").items())
        EXPECT_EQ(sha256Hex(text), digest.get<std::string>()) << text;
}

TEST(Digest, BulkDigestIsBlake2bWith32BytesOverAllParts) {
    const std::span<const std::byte> whole[] = {bytes("abc")};
    const std::span<const std::byte> parts[] = {bytes("a"), bytes(""), bytes("bc")};
    EXPECT_EQ(hexText(bulkDigest(whole)), test::figuresOf("digests").at("blake2b_32").at("abc").get<std::string>());
    EXPECT_EQ(bulkDigest(parts), bulkDigest(whole));
}

TEST(Digest, Crc32IsZlibsOverAllParts) {
    const std::span<const std::byte> parts[] = {bytes("1234"), {}, bytes("56789")};
    EXPECT_EQ(crc32(parts), test::figuresOf("digests").at("crc32").at("123456789").get<std::uint32_t>());
}

TEST(Chain, HashIsSha256OfThePreviousHashAndTheDocumentedText) {
    Digest previous;
    previous.fill(7);
    const Entry entry{12, "event", -5, "armed", R"({"a":1})", std::nullopt};
    std::string text(32, '\7');
    text.append("12\n-5\nevent\n5:armed\n7:{\"a\":1}\n-\n");
    EXPECT_EQ(hexText(chainHash(previous, entry)), sha256Hex(text));
}

TEST(Chain, EveryFieldCounts) {
    const Entry entry{12, "event", 5, "armed", "{}", Digest{}};
    const auto hash = chainHash(Digest{}, entry);
    auto other = entry;
    other.seq = 13;
    EXPECT_NE(chainHash(Digest{}, other), hash);
    other = entry;
    other.t_ns = 6;
    EXPECT_NE(chainHash(Digest{}, other), hash);
    other = entry;
    other.kind = "trial";
    EXPECT_NE(chainHash(Digest{}, other), hash);
    other = entry;
    other.name = "armed{";
    other.body = "}";
    EXPECT_NE(chainHash(Digest{}, other), hash);
    other = entry;
    other.digest.reset();
    EXPECT_NE(chainHash(Digest{}, other), hash);
    Digest previous{};
    previous[31] = 1;
    EXPECT_NE(chainHash(previous, entry), hash);
}

}  // namespace
}  // namespace tacto
