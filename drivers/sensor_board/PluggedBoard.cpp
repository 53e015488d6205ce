#include "drivers/sensor_board/PluggedBoard.h"

#include <algorithm>

#include "drivers/sensor_board/BoardReport.h"

namespace tacto::sensorboard {

PluggedBoard::PluggedBoard(std::unique_ptr<SensorBoard> board, Open open)
    : identity_(board->identity()),
      streams_(board->streams().begin(), board->streams().end()),
      encoder_(board->encoder()),
      open_(std::move(open)),
      board_(std::move(board)) {
    report_.write(board_->report());
}

Result<void> PluggedBoard::read(std::span<SampleBlock> blocks) {
    encoded_.clear();
    if (!board_) return fail(ErrorCode::Device, "{} {} is not open", identity_.name, identity_.serial);
    auto taken = board_->read(blocks);
    encoded_ = board_->encoded();
    report_.write(together(before_, board_->report()));
    return taken;
}

/// It is closed before the same device is opened again.
void PluggedBoard::close() {
    if (!board_) return;
    before_ = together(before_, board_->report());
    board_.reset();
}

Result<std::unique_ptr<SensorBoard>> PluggedBoard::openAgain() const {
    auto opened = open_(identity_.serial);
    if (!opened) return opened;
    const auto& found = **opened;
    const auto same = [](const StreamInfo& a, const StreamInfo& b) {
        return a.kind == b.kind && a.unit == b.unit && a.channels == b.channels && a.rate_hz == b.rate_hz;
    };
    if (!std::ranges::equal(found.streams(), streams_, same)) {
        return fail(ErrorCode::Device,
                    "{} {} came back with other streams than it had; close the bench and open it again", identity_.name,
                    identity_.serial);
    }
    return opened;
}

Result<void> PluggedBoard::reconnect() {
    close();
    auto opened = openAgain();
    if (!opened) return failure(opened);
    if ((*opened)->encoder() != encoder_) {
        return fail(ErrorCode::Device,
                    "{} {} came back with another profile in its encoder; close the bench and open it again",
                    identity_.name, identity_.serial);
    }
    board_ = std::move(*opened);
    return {};
}

Result<void> PluggedBoard::rewrite(const std::function<void()>& write) {
    close();
    write();
    auto opened = openAgain();
    if (!opened) return failure(opened);
    board_ = std::move(*opened);
    encoder_ = board_->encoder();
    return {};
}

DeviceReport PluggedBoard::deviceReport() const noexcept { return rowsOf(report_.read()); }

}  // namespace tacto::sensorboard
