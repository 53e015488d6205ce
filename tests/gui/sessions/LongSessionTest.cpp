// A session of hours is read for viewing in memory that does not grow with its length.
#include <gtest/gtest.h>
#include <random>

#include "app/gui/sessions/ReadSession.h"
#include "core/session/SessionWriter.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

constexpr int kFramesPerPart = 500;

/// Writes frames and trains of `parts` × 8 s; returns the largest amplitude.
double writeLong(const std::filesystem::path& path, int parts) {
    VirtualClock clock;
    std::mt19937 random(static_cast<unsigned>(parts));
    auto writer = SessionWriter::create(path, {}, clock).value();
    const int frames = writer->addStream(SessionStream{"frames", "frames", "", {"R", "P"}, 0}).value();
    double largest = 0;
    for (int part = 0; part < parts; ++part) {
        clock.advanceTo(std::chrono::seconds(8 * part));
        SampleBlock block;
        for (int i = 0; i < kFramesPerPart; ++i) {
            block.t_s.push_back(8 * part + i * 0.016);
            block.values.insert(block.values.end(), {std::uniform_real_distribution<double>(0, 1)(random), 0.5});
        }
        EXPECT_TRUE(writer->append(frames, block));
        for (int train = 0; train < 16; ++train) {
            const double amplitude = std::uniform_real_distribution<double>(10, 40)(random);
            largest = std::max(largest, amplitude);
            const auto at = clock.now() + std::chrono::milliseconds(500 * train);
            EXPECT_TRUE(writer->command(at, "train", {{"amplitude_v", 99}}));
            EXPECT_TRUE(writer->command(at, "delivered", {{"amplitude_v", amplitude}}));
        }
    }
    EXPECT_TRUE(writer->close());
    return largest;
}

TEST(LongSession, IsReadInMemoryThatDoesNotGrowWithItsLength) {
    const ScratchDir dir;
    for (const int parts : {10, 1200, 2400}) {  // up to 5.3 hours
        const auto path = dir.path() / (std::to_string(parts) + ".tacto");
        const double largest = writeLong(path, parts);
        const auto session = gui::readSession(path);
        ASSERT_TRUE(session) << session.error().message;
        const auto& course = session->course;
        EXPECT_EQ(session->delivered.trains, 16U * static_cast<unsigned>(parts));
        EXPECT_EQ(session->delivered.most, largest);
        EXPECT_EQ(course.unit, "V");
        ASSERT_EQ(course.train_s.size(), course.amplitude.size());
        EXPECT_LE(course.amplitude.size(), 10'000U);
        EXPECT_EQ(course.perTrain > 1, 16 * parts > 10'000);
        EXPECT_EQ(*std::ranges::max_element(course.amplitude), largest) << "the largest is never thinned out";
        EXPECT_TRUE(std::ranges::is_sorted(course.train_s));
        EXPECT_NEAR(course.train_s.back(), 8.0 * (parts - 1) + 7.5, 16.0);
        ASSERT_EQ(course.frame_s.size(), course.roughness.size());
        EXPECT_LE(course.frame_s.size(), 510'000U);
        EXPECT_EQ(course.oneIn > 1, kFramesPerPart * parts > 500'000) << parts;
        EXPECT_GE(course.frame_s.size(), std::min<std::size_t>(200'000, kFramesPerPart * static_cast<unsigned>(parts)));
    }
}

}  // namespace
}  // namespace tacto::test
