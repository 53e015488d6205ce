// FirmwareBoard.h - a sensor board in this process: the C99 loop that boards compile (resources/firmware/tactile_board)
// on the sensors of any TactileSensor, with the bytes of the sensor board protocol on its line.
//
// The board's loop turns every millisecond of the clock up to the moment at which the line is read, so that what it
// makes does not depend on how often that is. Samples leave in blocks of at most 10 ms; readings are digitised to
// kSteps; a sample that is not a number, or that its sensor left out, is one that the board could not fetch.
//
// Thread-safety: any thread.
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/base/Clock.h"
#include "core/devices/TactileSensor.h"
#include "core/devices/TransportPorts.h"
#include "resources/firmware/tactile_board/tactile_board.h"

namespace tacto::sensorboard {

class FirmwareBoard : public std::enable_shared_from_this<FirmwareBoard> {
public:
    static constexpr double kSteps[] = {0x1p-14, 0x1p-14, 0x1p-6};  ///< m/s2, N, Pa; a count is one

    /// `clock` outlives the board. `drift_ppm`: how much faster its clock runs. Errors: Unsupported for streams that no
    /// board has.
    [[nodiscard]] static Result<std::shared_ptr<FirmwareBoard>> make(std::unique_ptr<TactileSensor> sensors,
                                                                     std::string serial, std::string firmware,
                                                                     const Clock& clock, double drift_ppm);

    /// Switches it off and on: with this profile, or none. `rested`: nothing came out in the last 8 s, so that its
    /// encoder need not rest.
    void restart(const te_profile* profile, bool rested);
    /// A line to it. Its errors: Device, as the sensors.
    [[nodiscard]] std::unique_ptr<Transport> line();

private:
    class Line;
    /// The samples of one stream that the board has not read yet.
    struct Waiting {
        struct Sample {
            std::uint64_t at_us;
            std::uint64_t number;  ///< of all that the sensor made since the power came
            std::array<std::int32_t, TSB_COLUMNS_MOST> raw;
        };
        std::deque<Sample> samples;
        std::optional<double> first_s;  ///< of the sample with the number 0
        std::uint64_t next = 0;         ///< number of the sample after the last that was read
        std::uint8_t block = 1;
    };

    FirmwareBoard(std::unique_ptr<TactileSensor> sensors, std::string serial, std::string firmware, const Clock& clock,
                  double drift_ppm);
    [[nodiscard]] bool describe();
    void hear(std::span<const std::uint8_t> bytes) noexcept;
    [[nodiscard]] Result<std::size_t> say(std::span<std::uint8_t> into);
    [[nodiscard]] Result<void> run();
    [[nodiscard]] Result<void> fetch();
    void step();
    [[nodiscard]] bool next(tb_samples& into);
    [[nodiscard]] bool cut(std::size_t stream, tb_samples& into);
    [[nodiscard]] double boardTime_us(double session_s) const noexcept;

    std::mutex mutex_;  // guards all below
    const std::unique_ptr<TactileSensor> sensors_;
    const std::string serial_, firmware_;
    const Clock& clock_;
    const double rate_;  // of its clock
    double powered_s_ = 0;
    std::uint64_t now_us_ = 0;
    tb_setup setup_{};
    tb_hardware hardware_{};
    te_profile profile_{};
    const std::unique_ptr<tb_board> board_ = std::make_unique<tb_board>();
    std::vector<Waiting> waiting_;
    std::vector<SampleBlock> blocks_;
    std::deque<std::uint8_t> toBoard_, toHost_;
};

}  // namespace tacto::sensorboard
