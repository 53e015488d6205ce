#include <cstring>
#include <gtest/gtest.h>

#include "core/session/Chain.h"
#include "core/session/Digest.h"

namespace tacto {
namespace {

std::span<const std::byte> bytes(std::string_view text) { return std::as_bytes(std::span(text)); }

// Expected values are from the standards' own examples and from Python's hashlib and zlib.
TEST(Digest, Sha256MatchesThePublishedExamples) {
    EXPECT_EQ(sha256Hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256Hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Digest, BulkDigestIsBlake2bWith32BytesOverAllParts) {
    const std::span<const std::byte> whole[] = {bytes("abc")};
    const std::span<const std::byte> parts[] = {bytes("a"), bytes(""), bytes("bc")};
    EXPECT_EQ(hexText(bulkDigest(whole)), "bddd813c634239723171ef3fee98579b94964e3bb1cb3e427262c8c068d52319");
    EXPECT_EQ(bulkDigest(parts), bulkDigest(whole));
}

TEST(Digest, Crc32IsZlibsOverAllParts) {
    const std::span<const std::byte> parts[] = {bytes("1234"), {}, bytes("56789")};
    EXPECT_EQ(crc32(parts), 0xCBF43926U);
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
