// The board in real time: one thread listens, the session's thread reads, the window's thread reads the report.
#include <atomic>
#include <gtest/gtest.h>
#include <thread>

#include "core/acquisition/StreamHealth.h"
#include "drivers/sensor_board/SensorBoard.h"
#include "tests/support/FailsInTime.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"
#include "tests/support/emulated/sensor_board/EmulatedBoardLine.h"

namespace tacto::test {
namespace {

using namespace sensorboard;

class SensorBoardRealTime : public testing::Test {
protected:
    void SetUp() override {
        line_ = std::make_shared<EmulatedBoardLine>(clock_, nullptr, EmulatedBoardSettings{},
                                                    std::make_unique<CountingSignal>());
        auto transport = accepted(line_->connect());
        auto opened = SensorBoard::open(std::move(transport), {}, clock_);
        ASSERT_IN_TIME(opened);
        board_ = std::move(*opened);
    }
    /// Reads every 2 ms, as a session does, until `enough` or 20 s. Returns the first error.
    template <class Enough>
    Result<void> readUntil(Enough&& enough) {
        for (const Instant end = clock_.now() + std::chrono::seconds(20); clock_.now() < end && !enough();) {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            const auto begin = clock_.now();
            if (auto read = board_->read(blocks_); !read) return read;
            longest_ = std::max(longest_, clock_.now() - begin);
            for (const auto& block : blocks_) {
                if (block.samples() == 0) continue;
                EXPECT_LE(block.t_s.back(), toSeconds(clock_.now()) + 1e-6);
            }
        }
        return {};
    }

    SteadyClock clock_;
    std::shared_ptr<EmulatedBoardLine> line_;
    std::unique_ptr<SensorBoard> board_;
    std::vector<SampleBlock> blocks_{3};
    Instant longest_{0};
};

TEST_F(SensorBoardRealTime, NothingIsLostAndNothingIsStampedAhead) {
    RecordProperty("hazard", "H7");
    std::atomic<bool> ending{false};
    std::thread window([&] {
        while (!ending.load()) {
            EXPECT_IN_TIME(board_->report().streams[0].lostBlocks == 0U);
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
    });
    EXPECT_IN_TIME(readUntil([&] { return blocks_[0].samples() >= 8000; }).has_value());
    ending = true;
    window.join();
    ASSERT_IN_TIME(blocks_[0].samples() >= 8000U);
    const auto report = board_->report();
    EXPECT_IN_TIME(report.streams[0].lostBlocks + report.streams[1].lostBlocks + report.streams[2].lostBlocks == 0U);
    EXPECT_EQ(report.line.bad(), 0U);
    EXPECT_IN_TIME(report.dropped == 0U);
    // A busy computer may delay a thread, but must not reorder the samples.
    EXPECT_TRUE(std::is_sorted(blocks_[0].t_s.begin(), blocks_[0].t_s.end()));
}

TEST_F(SensorBoardRealTime, AnUnpluggedBoardIsAnErrorAfterWhatCameBefore) {
    RecordProperty("hazard", "H7");
    ASSERT_IN_TIME(readUntil([&] { return blocks_[0].samples() >= 400; }).has_value());
    line_->unplug();
    const auto begin = clock_.now();
    const auto gone = readUntil([] { return false; });
    ASSERT_FALSE(gone.has_value());
    EXPECT_CODE_IN_TIME(gone.error().code, ErrorCode::Device);
    EXPECT_NE(gone.error().message.find("unplugged"), std::string::npos);
    EXPECT_IN_TIME(clock_.now() - begin < std::chrono::seconds(1));
}

TEST_F(SensorBoardRealTime, GoesAtOnceAndTellsTheBoardToStop) {
    ASSERT_IN_TIME(readUntil([&] { return blocks_[0].samples() >= 400; }).has_value());
    const auto begin = clock_.now();
    board_.reset();
    EXPECT_IN_TIME(clock_.now() - begin < std::chrono::seconds(1));
    EXPECT_FALSE(line_->inspect([](EmulatedBoard& board, Instant) { return board.running(); }));
}

}  // namespace
}  // namespace tacto::test
