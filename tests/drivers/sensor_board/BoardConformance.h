// BoardConformance.h - tests that every sensor board must pass, by the frames of PROTOCOL.md alone. A board's tests
// give a factory, as for tests/drivers/conformance; one that encodes its samples passes EncodingBoardConformance too.
//
// Thread-safety: the test's own thread.
#pragma once

#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include "core/base/Clock.h"
#include "core/devices/TransportPorts.h"
#include "drivers/sensor_board/Messages.h"

namespace tacto::test {

class BoardRig {
public:
    virtual ~BoardRig() = default;
    [[nodiscard]] virtual Transport& line() = 0;
    [[nodiscard]] virtual const Clock& clock() const = 0;
    virtual void wait(Seconds duration) = 0;
};

struct BoardKind {
    std::string name;
    std::function<std::unique_ptr<BoardRig>()> make;
};

/// A frame that a board sent.
struct Told {
    std::uint8_t version = 0, type = 0;
    std::vector<std::uint8_t> payload;
    [[nodiscard]] sensorboard::Frame frame() const { return {version, type, payload}; }
    [[nodiscard]] bool is(sensorboard::Reply reply) const { return frame().is(reply); }
};

/// A host that speaks to a board by frames alone.
class PlainHost {
public:
    explicit PlainHost(BoardRig& rig) : rig_(rig) {}
    void write(std::span<const std::uint8_t> bytes);
    /// Sends a command and returns its answer; what comes before it is added to `told`. Fails the test if none comes.
    [[nodiscard]] Told ask(sensorboard::Command command, std::vector<std::uint8_t> payload = {});
    /// Adds what comes to `told` until it holds `count` of `reply`; returns false if it does not in 20 s.
    [[nodiscard]] bool hear(sensorboard::Reply reply, std::size_t count = 1);
    /// Adds what comes in `duration` to `told`.
    void listen(Seconds duration);
    [[nodiscard]] const sensorboard::LineCounts& counts() const { return decoder_.counts(); }

    std::vector<Told> told;

private:
    template <class Enough>
    [[nodiscard]] bool hearUntil(Seconds most, Enough enough);

    BoardRig& rig_;
    sensorboard::FrameDecoder decoder_;
    std::uint8_t token_ = 0;
};

class BoardConformance : public testing::TestWithParam<BoardKind> {
protected:
    void SetUp() override;
    [[nodiscard]] sensorboard::BoardStatus status();
    void order(sensorboard::Command command);
    void expectRefused(sensorboard::Command command, std::vector<std::uint8_t> payload, int reason);
    [[nodiscard]] sensorboard::StreamConfiguration configuration(std::uint8_t stream);
    void setEncoder(bool encodes);

    std::unique_ptr<BoardRig> rig_;
    std::unique_ptr<PlainHost> host_;
};

class EncodingBoardConformance : public BoardConformance {};

}  // namespace tacto::test
