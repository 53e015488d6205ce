// BoardOnPty.h - the emulated sensor board behind a pseudo-terminal, for `sensor:?tty=` and for programs in another
// process.
//
// Thread-safety: all members any thread.
#pragma once

#include <string>

#include "tests/drivers/sensor_board/BoardFeed.h"

namespace tacto::test {

class BoardOnPty {
public:
    /// Throws where the system gives no pseudo-terminal.
    explicit BoardOnPty(const Clock& clock, sensorboard::EmulatedBoardSettings settings = {},
                        BoardFeed::MakeSignal signal = {});
    ~BoardOnPty();
    BoardOnPty(const BoardOnPty&) = delete;
    BoardOnPty& operator=(const BoardOnPty&) = delete;

    /// What to open, "/dev/pts/3".
    [[nodiscard]] const std::string& path() const noexcept { return path_; }
    [[nodiscard]] BoardFeed& board() noexcept { return *feed_; }

private:
    void listen();

    int master_ = -1;
    int slave_ = -1;  // held open, so that a client may come and go
    int wake_ = -1;
    std::string path_;
    std::unique_ptr<BoardFeed> feed_;
    std::thread listener_;
};

}  // namespace tacto::test
