#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <rapidcheck.h>

#include "core/session/Chunk.h"
#include "tests/session/SessionSupport.h"

namespace tacto {
namespace {

using test::sameBits;
using test::ScratchDir;

/// Any double, often a difficult one.
rc::Gen<double> anyDouble() {
    return rc::gen::oneOf(
        rc::gen::map(rc::gen::arbitrary<std::uint64_t>(),
                     [](std::uint64_t bits) { return std::bit_cast<double>(bits); }),
        rc::gen::element(0.0, -0.0, std::nan(""), std::numeric_limits<double>::infinity(),
                         -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::denorm_min(), 1e300));
}

TEST(SessionStream, AnyStampsAndValuesComeBackBitByBitUnlessTheStampsAreALine) {
    const bool held = rc::check([] {
        const ScratchDir dir;
        const auto path = dir.path() / "s.tacto";
        VirtualClock clock;
        const auto columns = *rc::gen::inRange<std::size_t>(1, 12);
        SampleBlock all;
        {
            auto writer = SessionWriter::create(path, {}, clock).value();
            SessionStream stream{"any", "", "", std::vector<std::string>(columns, "c"), 0};
            const int id = writer->addStream(stream).value();
            const auto blocks = *rc::gen::inRange(0, 8);
            for (int b = 0; b < blocks; ++b) {
                const auto samples = *rc::gen::inRange<std::size_t>(0, 40);
                SampleBlock block;
                block.t_s = *rc::gen::container<std::vector<double>>(samples, anyDouble());
                block.values = *rc::gen::container<std::vector<double>>(samples * columns, anyDouble());
                RC_ASSERT(writer->append(id, block).has_value());
                if (*rc::gen::arbitrary<bool>()) clock.advanceTo(clock.now() + std::chrono::milliseconds(900));
                all.t_s.insert(all.t_s.end(), block.t_s.begin(), block.t_s.end());
                all.values.insert(all.values.end(), block.values.begin(), block.values.end());
            }
        }
        const auto back = SessionReader::open(path)->samples(1).value();
        RC_ASSERT(sameBits(back.values, all.values));
        RC_ASSERT(back.t_s.size() == all.t_s.size());
        for (std::size_t i = 0; i < all.t_s.size(); ++i) {
            const bool same = std::bit_cast<std::uint64_t>(back.t_s[i]) == std::bit_cast<std::uint64_t>(all.t_s[i]);
            RC_ASSERT(same || std::abs(back.t_s[i] - all.t_s[i]) <= 1e-9);
        }
        RC_ASSERT(verifySession(path)->status == SessionStatus::Intact);
    });
    EXPECT_TRUE(held);
}

TEST(SessionStream, RegularStampsComeBackToTheNanosecondAndCostNothing) {
    const ScratchDir dir;
    const auto size = [&](bool jitter) {
        std::mt19937 random(1);
        std::uniform_real_distribution<double> late(0, 2e-6);
        std::vector<double> stamps;
        const auto path = dir.path() / (jitter ? "jitter.tacto" : "regular.tacto");
        VirtualClock clock;
        auto writer = SessionWriter::create(path, {}, clock).value();
        const int id = writer->addStream(SessionStream{"a", "acceleration", "m/s2", {"x"}, 4000}).value();
        for (int i = 0; i < 100; ++i) {
            auto block = test::ramp(7000 + i * 0.25, 4000, 1000, 1);
            for (std::size_t s = 0; jitter && s < block.t_s.size(); s += 2) block.t_s[s] += late(random);
            stamps.insert(stamps.end(), block.t_s.begin(), block.t_s.end());
            EXPECT_TRUE(writer->append(id, block));
            clock.advanceTo(toInstant(i * 0.25));
        }
        EXPECT_TRUE(writer->close());
        const auto back = SessionReader::open(path)->samples(1).value();
        EXPECT_EQ(back.samples(), 100'000U);
        for (std::size_t i = 0; i < back.samples(); ++i) EXPECT_NEAR(back.t_s[i], stamps[i], 1e-9);
        return std::filesystem::file_size(path);
    };
    const auto regular = size(false);
    EXPECT_LT(regular, 100'000U) << "no stamps, and a ramp is packed";
    EXPECT_GT(size(true), regular + 100'000U) << "irregular stamps are stored one by one";
}

TEST(SessionStream, ListsStreamsWithTheirExtent) {
    const ScratchDir dir;
    test::writeSession(dir.path() / "s.tacto");
    const auto reader = SessionReader::open(dir.path() / "s.tacto");
    const auto streams = reader->streams().value();
    ASSERT_EQ(streams.size(), 2U);
    EXPECT_EQ(streams[0].id, 1);
    EXPECT_EQ(streams[0].stream,
              (SessionStream{"fingertip accelerometer", "acceleration", "m/s2", {"x", "y", "z"}, 1000}));
    EXPECT_EQ(streams[0].samples, 3000U);
    EXPECT_EQ(streams[0].first_s, 0);
    EXPECT_NEAR(streams[0].last_s, 2.999, 1e-9);
    const auto frames = reader->samples(2).value();
    ASSERT_EQ(frames.samples(), 60U);
    EXPECT_TRUE(std::isnan(frames.values[2]));
    EXPECT_EQ(reader->samples(3).error().code, ErrorCode::NotFound);
}

TEST(SessionStream, ChunksAreVisitedInOrderUntilTheVisitorHasEnough) {
    const ScratchDir dir;
    test::writeSession(dir.path() / "s.tacto");
    const auto reader = SessionReader::open(dir.path() / "s.tacto");
    int chunks = 0;
    double last = -1;
    ASSERT_TRUE(reader->forEachChunk(1, [&](const SampleBlock& block) {
        ++chunks;
        EXPECT_GT(block.t_s.front(), last);
        last = block.t_s.back();
        return true;
    }));
    EXPECT_GE(chunks, 3);
    int visited = 0;
    ASSERT_TRUE(reader->forEachChunk(1, [&](const SampleBlock&) { return ++visited < 2; }));
    EXPECT_EQ(visited, 2);
}

TEST(SessionStream, AnOutlineHasAboutTheValuesAskedForAndGapsBetween) {
    const ScratchDir dir;
    VirtualClock clock;
    {
        auto writer = SessionWriter::create(dir.path() / "s.tacto", {}, clock).value();
        const int id = writer->addStream(SessionStream{"a", "", "", {"x", "y"}, 100}).value();
        for (int second = 0; second < 200; ++second) {
            clock.advanceTo(std::chrono::seconds(second));
            ASSERT_TRUE(writer->append(id, test::ramp(second, 100, 100, 2)));
        }
    }
    const auto reader = SessionReader::open(dir.path() / "s.tacto").value();
    const auto all = reader.samples(1).value();
    EXPECT_EQ(reader.outline(2, 1000).error().code, ErrorCode::NotFound);
    const auto damaged = SessionReader::openDamaged(dir.path() / "s.tacto").value();
    for (const std::uint64_t most : {1U, 399U, 4000U, 20'000U, 39'999U, 40'001U, 1'000'000U}) {
        const auto outline = reader.outline(1, most).value();
        const auto readable = damaged.outline(1, most).value();
        EXPECT_EQ(readable.oneIn, outline.oneIn);
        EXPECT_EQ(readable.samples.t_s, outline.samples.t_s) << "a damaged session needs no more memory";
        const auto& some = outline.samples;
        ASSERT_EQ(some.values.size(), 2 * some.samples());
        EXPECT_EQ(outline.oneIn > 1, most < all.values.size()) << most;
        EXPECT_LE(some.values.size(), most + 2 * 102 * 2) << "one chunk and the gaps more";
        if (most >= 4000) EXPECT_GE(some.values.size(), std::min<std::size_t>(most, all.values.size()) / 3) << most;
        std::size_t at = 0;
        for (std::size_t i = 0; i < some.samples(); ++i) {
            if (std::isnan(some.values[2 * i])) {
                EXPECT_GT(outline.oneIn, 1);
                continue;
            }
            while (at < all.samples() && all.t_s[at] != some.t_s[i]) ++at;
            ASSERT_LT(at, all.samples()) << "in order, and recorded";
            EXPECT_EQ(all.values[2 * at], some.values[2 * i]);
            EXPECT_EQ(all.values[2 * at + 1], some.values[2 * i + 1]);
        }
    }
}

TEST(SessionStream, NamesTheColumnsOfASensor) {
    const ScratchDir dir;
    VirtualClock clock;
    auto writer = SessionWriter::create(dir.path() / "s.tacto", {}, clock).value();
    ASSERT_TRUE(writer->addStream(
        StreamInfo{StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 3, 4000, "accelerometer"}));
    ASSERT_TRUE(writer->addStream(StreamInfo{StreamKind::Force, StreamUnit::Newton, 1, 200, "force sensor"}));
    ASSERT_TRUE(writer->addStream(StreamInfo{StreamKind::Taxels, StreamUnit::Count, 10, 200, "array"}));
    ASSERT_TRUE(writer->close());
    const auto streams = SessionReader::open(dir.path() / "s.tacto")->streams().value();
    EXPECT_EQ(streams[0].stream.columns, (std::vector<std::string>{"x", "y", "z"}));
    EXPECT_EQ(streams[1].stream.columns, (std::vector<std::string>{"force"}));
    EXPECT_EQ(streams[1].stream.unit, "N");
    EXPECT_EQ(streams[2].stream.columns.back(), "c10");
    EXPECT_EQ(streams[2].stream.kind, "taxels");
    EXPECT_TRUE(std::isnan(streams[2].first_s));
}

TEST(SessionStream, ALineNeedsFiniteEvenStamps) {
    EXPECT_FALSE(lineThrough({}));
    const double single[] = {3.5};
    EXPECT_TRUE(lineThrough(single));
    const double broken[] = {0, std::nan(""), 2};
    EXPECT_FALSE(lineThrough(broken));
    const double gap[] = {0, 1, 2, 4};
    EXPECT_FALSE(lineThrough(gap));
    const double nearly[] = {0, 1 + 5e-10, 2};
    EXPECT_TRUE(lineThrough(nearly));
    const double notQuite[] = {0, 1 + 2e-9, 2};
    EXPECT_FALSE(lineThrough(notQuite));
}

}  // namespace
}  // namespace tacto
