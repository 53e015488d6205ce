// BoardFeed.h - the emulated sensor board in real time: a thread of its own sends what is due, as a board's own clock
// does. Its creator carries its bytes: an emulated USB node, a pseudo-terminal.
//
// Thread-safety: all members any thread.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "core/base/Clock.h"
#include "tests/support/emulated/sensor_board/EmulatedBoard.h"

namespace tacto::test {

class BoardFeed {
public:
    using Send = std::function<void(std::span<const std::uint8_t>)>;
    using MakeSignal = std::function<std::unique_ptr<sensorboard::BoardSignal>(Instant)>;

    /// `send` is called by the thread, with nothing locked. Without a signal the board counts (CountingSignal), so that
    /// a sample that is missing shows.
    BoardFeed(const Clock& clock, sensorboard::EmulatedBoardSettings settings, Send send, MakeSignal signal = {});
    ~BoardFeed();
    BoardFeed(const BoardFeed&) = delete;
    BoardFeed& operator=(const BoardFeed&) = delete;

    /// Bytes from the host.
    void receive(std::span<const std::uint8_t> bytes);
    /// Without power it says nothing; with power again its clock starts over and it waits for START.
    void power(bool on);

    /// Sends no more; for an owner whose `send` ends before this does. May be repeated.
    void stop();

    /// Does something with the board while no other thread does.
    template <class Act>
    auto inspect(Act act) {
        const std::scoped_lock lock(mutex_);
        return act(*board_, clock_.now());
    }

private:
    [[nodiscard]] std::unique_ptr<sensorboard::EmulatedBoard> powerUp() const;
    void run();

    const Clock& clock_;
    const sensorboard::EmulatedBoardSettings settings_;
    const Send send_;
    const MakeSignal signal_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::unique_ptr<sensorboard::EmulatedBoard> board_;  // guarded by mutex_
    bool powered_ = true;                                // guarded by mutex_
    bool quitting_ = false;                              // guarded by mutex_
    std::thread thread_;                                 // Last: starts when all else is ready
};

}  // namespace tacto::test
