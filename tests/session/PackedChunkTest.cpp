#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "core/packing/PackedColumns.h"
#include "core/session/Database.h"
#include "tests/session/SessionSupport.h"
#include "tests/support/Trials.h"

namespace tacto {
namespace {

using test::sameBits;
using test::ScratchDir;
using Random = std::mt19937_64;

double between(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

/// Fills a column as one of the sources of samples would: a converter, a computation, a fault.
void fillColumn(SampleBlock& block, std::size_t column, std::size_t columns, Random& random) {
    const auto kind = random() % 9;
    const double step = std::exp(between(random, -30, 30)) * (random() % 2 == 0 ? 1 : -1);
    const double offset = random() % 2 == 0 ? 0 : between(random, -1e3, 1e3) * step;
    const auto bits = 1 + random() % 24;
    double walk = 0;
    for (std::size_t i = 0; i < block.samples(); ++i) {
        const auto code =
            static_cast<double>(random() >> (64 - bits)) - static_cast<double>(std::uint64_t{1} << bits) / 2;
        walk += std::floor(between(random, -3, 4));
        double value = 0;
        if (kind == 0) value = code * step + offset;
        if (kind == 1) value = walk * step + offset;
        if (kind == 2) value = code / 1000;
        if (kind == 3) value = between(random, -1, 1) * step;
        if (kind == 4) value = step;
        if (kind == 5) value = std::bit_cast<double>(random());
        if (kind == 6) value = static_cast<double>(random() % 2) * -0.0;
        if (kind == 7) value = std::numeric_limits<double>::denorm_min() * code;
        if (kind == 8) value = std::ldexp(code, static_cast<int>(random() % 2000) - 1000);
        if (random() % 100 == 0) value = std::bit_cast<double>(0x7ff0'0000'0000'0000U | random());  // NaN with payload
        if (random() % 100 == 0) value = std::bit_cast<double>((random() & 1U) << 63U | 0x7ff0'0000'0000'0000U);
        block.values[i * columns + column] = value;
    }
}

SampleBlock anyBlock(Random& random, std::size_t columns) {
    SampleBlock block;
    const std::size_t samples = random() % (random() % 10 == 0 ? 3000 : 200);
    const double rate = std::exp(between(random, -3, 12));
    for (std::size_t i = 0; i < samples; ++i)
        block.t_s.push_back(static_cast<double>(i) / rate + (random() % 2 == 0 ? between(random, 0, 1e-4) : 0));
    block.values.resize(samples * columns);
    for (std::size_t c = 0; c < columns; ++c) fillColumn(block, c, columns, random);
    return block;
}

TEST(PackedColumns, ComeBackBitByBit) {
    RecordProperty("hazard", "H8");
    int packed = 0;
    const int streams = test::trials<int>({.local = 300, .ci = 3000, .campaign = 100'000});
    for (int seed = 0; seed < streams; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        ColumnPacker packer;
        const std::size_t columns = 1 + random() % 12;
        for (int chunk = 0; chunk < 4; ++chunk) {
            const auto block = anyBlock(random, columns);
            const bool withStamps = random() % 2 == 0;
            const auto bytes = packer.pack(block, withStamps);
            if (bytes.empty()) continue;
            ++packed;
            SampleBlock back;
            const auto done = unpackColumns(bytes, block.samples(), columns, withStamps, back);
            ASSERT_TRUE(done) << "seed " << seed << ": " << done.error().message;
            ASSERT_TRUE(sameBits(back.values, block.values)) << "seed " << seed;
            ASSERT_EQ(back.samples(), block.samples());
            if (withStamps) ASSERT_TRUE(sameBits(back.t_s, block.t_s)) << "seed " << seed;
            EXPECT_LE(bytes.size() * 10, (columns + (withStamps ? 1 : 0)) * block.samples() * 8 * 9 + 10) << seed;
        }
    }
    EXPECT_GT(packed, streams);
}

TEST(PackedColumns, OfAConverterTakeASixthWhateverItsStepAndOffset) {
    Random random(7);
    for (int converter = 0; converter < 20; ++converter) {
        const double step = static_cast<float>(std::exp(between(random, -12, 3)));  // as boards state them
        const double offset = converter % 2 == 0 ? 0 : static_cast<float>(between(random, -500, 500) * step);
        std::normal_distribution<double> noise(0, 30);
        SampleBlock block;
        for (int i = 0; i < 3200; ++i) {
            block.t_s.push_back(i / 4000.0);
            for (int axis = 0; axis < 3; ++axis)
                block.values.push_back(std::round(300 * std::sin(i * 0.01) + noise(random)) * step + offset);
        }
        ColumnPacker packer;
        EXPECT_LT(packer.pack(block, false).size(), block.values.size() * sizeof(double) / 6) << step << " " << offset;
    }
}

/// Changes bytes as a damaged disk or a stranger would.
std::vector<std::byte> damaged(std::span<const std::byte> good, Random& random) {
    std::vector<std::byte> bytes(good.begin(), good.end());
    const auto kind = random() % 3;
    if (kind == 0) bytes.resize(random() % (bytes.size() + 1));
    if (kind == 1) bytes.insert(bytes.end(), 1 + random() % 20, static_cast<std::byte>(random()));
    for (std::size_t flips = kind == 2 ? 1 + random() % 8 : random() % 2; flips > 0 && !bytes.empty(); --flips)
        bytes[random() % bytes.size()] ^= static_cast<std::byte>(1U << random() % 8);
    return bytes;
}

TEST(PackedColumns, ThatAreDamagedAreRefusedOrHaveTheStatedSize) {
    RecordProperty("hazard", "H10");
    int refused = 0;
    const int trials = test::trials<int>({.local = 3000, .ci = 30'000, .campaign = 1'000'000});
    Random random(50);
    SampleBlock back;
    for (int trial = 0; trial < trials;) {
        ColumnPacker packer;
        const std::size_t columns = 1 + random() % 12;
        const auto block = anyBlock(random, columns);
        const bool withStamps = random() % 2 == 0;
        const auto good = packer.pack(block, withStamps);
        for (int i = 0; i < 20; ++i, ++trial) {
            const auto bytes = damaged(good, random);
            const auto samples = random() % 4 == 0 ? random() >> random() % 64 : block.samples();
            const auto stated = random() % 4 == 0 ? 1 + random() % 20 : columns;
            if (const auto done = unpackColumns(bytes, samples, stated, withStamps, back)) {
                EXPECT_EQ(back.samples(), samples);
                EXPECT_EQ(back.values.size(), samples * stated);
            } else {
                ++refused;
                EXPECT_EQ(done.error().code, ErrorCode::ParseError);
            }
            EXPECT_LE(back.values.capacity() + back.t_s.capacity(), 2 * kMaxPackedNumbers);
        }
    }
    EXPECT_GT(refused, trials / 3);
}

TEST(PackedColumns, ThatStateAHugeSizeAreRefusedBeforeMemoryIsTaken) {
    RecordProperty("hazard", "H10");
    SampleBlock back;
    for (const unsigned high : {0x00U, 0x01U, 0x7fU, 0xffU}) {
        // The header of a zstd frame with an 8-byte content size, and an empty last block.
        std::vector<std::byte> bytes{std::byte{0x28}, std::byte{0xb5}, std::byte{0x2f}, std::byte{0xfd},
                                     std::byte{0xe0}};
        for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<std::byte>(i < 5 ? 0xff : high));
        for (const unsigned last : {1U, 0U, 0U}) bytes.push_back(static_cast<std::byte>(last));
        for (const std::uint64_t samples : {std::uint64_t{100}, std::uint64_t{1} << 20, ~std::uint64_t{0}})
            EXPECT_FALSE(unpackColumns(bytes, samples, 1, false, back));
    }
    EXPECT_FALSE(unpackColumns({}, 1, 1, true, back));
    EXPECT_FALSE(unpackColumns({}, 1, ~std::size_t{0}, true, back));
}

/// packed-chunk.f64 holds 120 stamps, and then the values of three channels on grids whose base and step are rounded.
TEST(PackedColumns, ThatAnotherBuildPackedHaveTheSameBits) {
    RecordProperty("hazard", "H8");
    const auto folder = test::sourceDir() / "tests/session";
    const auto packed = test::bytesOf(folder / "packed-chunk.bin"), plain = test::bytesOf(folder / "packed-chunk.f64");
    constexpr std::size_t kSamples = 120, kChannels = 3;
    std::vector<double> wanted(kSamples * (1 + kChannels));
    ASSERT_EQ(plain.size(), wanted.size() * sizeof(double));
    std::memcpy(wanted.data(), plain.data(), plain.size());
    SampleBlock back;
    const auto done = unpackColumns(std::as_bytes(std::span(packed)), kSamples, kChannels, true, back);
    ASSERT_TRUE(done) << done.error().message;
    back.t_s.insert(back.t_s.end(), back.values.begin(), back.values.end());
    EXPECT_TRUE(sameBits(back.t_s, wanted));
}

class PackedSession : public testing::Test {
protected:
    void SetUp() override { RecordProperty("hazard", "H8"); }
    /// Writes what plain-chunks.tacto holds, which a program without packing wrote with the same calls.
    void write() const {
        VirtualClock clock;
        auto session = SessionWriter::create(path_, test::someAbout(), clock).value();
        const auto a =
            session->addStream(SessionStream{"fingertip accelerometer", "acceleration", "m/s2", {"x", "y", "z"}, 100});
        const auto f = session->addStream(SessionStream{"roughness frames", "frames", "", {"R", "P"}, 0});
        for (int part = 0; part < 20; ++part) {
            const double t = part / 10.0;
            clock.advanceTo(toInstant(t));
            ASSERT_TRUE(session->append(*a, test::ramp(t, 100, 10, 3)));
            SampleBlock frame;
            frame.t_s = {t, t + 0.03 * (part % 3)};
            frame.values = {0.5, 0.25, std::nan(""), -0.0};
            ASSERT_TRUE(session->append(*f, frame));
        }
        Capture capture;
        capture.rate_hz = 1e6;
        capture.channels = {{"voltage", "V", {1, 2, 3}, -50, 50, 0.4, 0.01, 0.2}};
        const auto trial = session->trial(clock.now(), "rough-high", {{"amplitude_v", 39.9}});
        ASSERT_TRUE(session->capture(clock.now(), capture, *trial));
        ASSERT_TRUE(session->close());
    }
    [[nodiscard]] std::string problems() const {
        std::string all;
        const auto report = verifySession(path_).value();
        for (const auto& problem : report.problems) all += problem + "\n";
        return all;
    }
    ScratchDir dir_;
    std::filesystem::path path_ = dir_.path() / "s.tacto";
    std::filesystem::path old_ = test::sourceDir() / "tests/session/plain-chunks.tacto";
};

TEST_F(PackedSession, SaysWhatAnOlderProgramRecordedByTheSameCalls) {
    write();
    const auto before = verifySession(old_).value();
    EXPECT_EQ(before.status, SessionStatus::Intact);
    EXPECT_EQ(before.samples, verifySession(path_)->samples);
    EXPECT_EQ(before.head, "7d0b34157d52b7fed2b1a8f0e3d3efdbf9362634fddfd89f295bf9dfd379c6bc");
    const auto older = SessionReader::open(old_);
    const auto newer = SessionReader::open(path_);
    EXPECT_EQ(newer->reproducibleText().value(), older->reproducibleText().value());
    for (const int stream : {1, 2}) {
        EXPECT_TRUE(sameBits(newer->samples(stream)->values, older->samples(stream)->values));
        EXPECT_TRUE(sameBits(newer->samples(stream)->t_s, older->samples(stream)->t_s));
        for (const auto* reader : {&*older, &*newer}) {
            std::vector<double> stamps;
            ASSERT_TRUE(reader->forEachStamps(stream, [&](std::span<const double> some) {
                stamps.insert(stamps.end(), some.begin(), some.end());
                return true;
            }));
            EXPECT_TRUE(sameBits(stamps, reader->samples(stream)->t_s));
        }
    }
    EXPECT_NE(test::everythingIn(path_).find(kPackedAsSteps), std::string::npos) << "the test must pack";
}

TEST_F(PackedSession, ThatIsDamagedIsReportedAsOneWithPlainChunks) {
    write();
    const auto good = test::bytesOf(path_);
    const auto chunk = [&] {
        const auto database = Database::open(path_.string(), 1 /* SQLITE_OPEN_READONLY */).value();
        auto row = database.prepare("SELECT data FROM chunks WHERE stream=1 AND idx=1").value();
        EXPECT_TRUE(row.step().value());
        return std::vector<std::byte>(row.blob(0).begin(), row.blob(0).end());
    }();
    Random random(9);
    int checksums = 0;
    for (int i = 0; i < 60; ++i) {
        const auto bytes = damaged(chunk, random);
        if (bytes == chunk) continue;
        std::string hex;
        for (const auto byte : bytes) hex += fmt::format("{:02x}", static_cast<unsigned>(byte));
        test::writeBytes(path_, good);
        test::forge(path_, "UPDATE chunks SET data=x'" + hex + "' WHERE stream=1 AND idx=1");
        const auto report = problems();
        EXPECT_NE(report.find("the samples of chunk 1 of stream 'fingertip accelerometer' (samples 90 to 169) were "
                              "altered: their hash is wrong"),
                  std::string::npos)
            << report;
        const bool same =
            SessionReader::open(path_)->samples(1).has_value() &&
            sameBits(SessionReader::open(path_)->samples(1)->values, SessionReader::open(old_)->samples(1)->values);
        EXPECT_EQ(report.find("does not match its CRC-32") == std::string::npos, same) << report;
        checksums += same ? 0 : 1;
    }
    EXPECT_GT(checksums, 40);
}

TEST_F(PackedSession, WithManyDamagedChunksReportsThemInOrderAndCountsTheRest) {
    VirtualClock clock;
    Random random(3);
    {
        auto session = SessionWriter::create(path_, {}, clock).value();
        const int id = session->addStream(SessionStream{"a", "", "", {"x", "y"}, 100}).value();
        for (int chunk = 0; chunk < 60; ++chunk) {
            clock.advanceTo(std::chrono::seconds(chunk));
            auto block = test::ramp(chunk, 4000, 4000, 2);
            for (auto& value : block.values) value = static_cast<double>(random() % 65'536) * 0.1;
            ASSERT_TRUE(session->append(id, block));
        }
    }
    EXPECT_EQ(verifySession(path_)->status, SessionStatus::Intact);
    test::forge(path_, "UPDATE chunks SET data=substr(data, 1, length(data) - 1)");
    const auto report = verifySession(path_).value();
    ASSERT_EQ(report.problems.size(), 41U);
    for (std::size_t i = 0; i < 39; i += 3) {
        const auto chunk = fmt::format("chunk {} of stream 'a'", i / 3);
        EXPECT_TRUE(report.problems[i].starts_with(chunk)) << report.problems[i];
        EXPECT_TRUE(report.problems[i + 1].starts_with("the samples of " + chunk)) << report.problems[i + 1];
        EXPECT_TRUE(report.problems[i + 2].starts_with("row ")) << report.problems[i + 2];
    }
    EXPECT_EQ(report.problems.back(), fmt::format("and {} more", 3 * report.chunks - 40));
}

TEST_F(PackedSession, WithAnUnknownPackingIsRefusedByOneSentence) {
    write();
    test::forge(path_, "UPDATE entries SET body=replace(body, 'steps+zstd', 'steps+brotli')");
    const auto read = SessionReader::open(path_)->samples(1);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::Unsupported);
    EXPECT_EQ(read.error().message,
              "chunk 0 of stream 1 cannot be unpacked: it is packed as 'steps+brotli', and this program knows "
              "'steps+zstd'");
    EXPECT_NE(problems().find(read.error().message), std::string::npos);
    EXPECT_EQ(problems().find("CRC-32"), std::string::npos) << "nothing is known of its samples";
}

}  // namespace
}  // namespace tacto
