// sensor: shows a technician a sensor board's identity, its settings and the quality of its connection, and how well
// the board's own encoder agrees with the bench.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <thread>
#include <unistd.h>
#include <vector>

#include "app/cli/Command.h"
#include "app/cli/EncoderOptions.h"
#include "app/cli/Say.h"
#include "app/cli/SensorCompare.h"
#include "app/cli/TextTable.h"
#include "app/run/AllDrivers.h"
#include "app/run/SignalStop.h"
#include "core/acquisition/StreamHealth.h"
#include "core/base/JsonText.h"
#include "drivers/sensor_board/BoardReport.h"
#include "drivers/sensor_board/SensorBoard.h"
#include "drivers/sensor_board/SensorBoardDriver.h"

namespace tacto::cli {

namespace {

struct Listened {
    double seconds = 0;                ///< how long the command listened
    std::vector<HealthReport> health;  ///< in the order of SensorBoard::streams()
    SensorBoardReport report;
};

using SteadyTime = std::chrono::steady_clock::time_point;

constexpr std::chrono::milliseconds kReadEvery(2);
constexpr double kShowEvery_s = 0.25;

/// Shows on a terminal the remaining time.
class Countdown {
public:
    explicit Countdown(double whole_s) : whole_s_(whole_s), terminal_(isatty(STDERR_FILENO) != 0) {}
    ~Countdown() {
        if (terminal_) say(stderr, "\r\033[K");
    }
    Countdown(const Countdown&) = delete;
    Countdown& operator=(const Countdown&) = delete;
    void show(double passed_s) {
        if (!terminal_ || passed_s < next_s_) return;
        next_s_ = passed_s + kShowEvery_s;
        say(stderr, "\r\033[Klistening, {:.0f} s left", whole_s_ - passed_s);
        std::fflush(stderr);
    }

private:
    const double whole_s_;
    const bool terminal_;
    double next_s_ = 0;
};

/// Listens for `time`, or until Ctrl+C is pressed. Errors: as SensorBoard::read().
Result<Listened> listenTo(SensorBoard& board, Seconds time, const SignalStop& interrupts) {
    const auto streams = board.streams();
    std::vector<StreamHealth> health;
    for (const auto& stream : streams) health.emplace_back(stream.rate_hz);
    std::vector<SampleBlock> blocks(streams.size());
    Countdown countdown(time.count());
    const SteadyTime begin = std::chrono::steady_clock::now();
    Listened heard;
    while (heard.seconds < time.count() && !interrupts.signalled()) {
        std::this_thread::sleep_for(kReadEvery);
        for (auto& block : blocks) block.clear();
        if (const auto read = board.read(blocks); !read) return failure(read);
        for (std::size_t i = 0; i < blocks.size(); ++i) health[i].feed(blocks[i], streams[i].channels);
        heard.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        countdown.show(heard.seconds);
    }
    for (const auto& one : health) heard.health.push_back(one.report());
    heard.report = board.report();
    return heard;
}

using nlohmann::json;
using sensorboard::SampleFormat;

constexpr double kMinSeconds = 0.5;
constexpr double kMaxSeconds = 3600;
constexpr double kSecondsUsual = 2;
constexpr double kSecondsCompared = 20;

void declareSensor(QCommandLineParser& parser) {
    parser.addOption(
        {"seconds",
         "How long to listen, 0.5 to 3600 s; a longer time makes the clock drift more certain (status: 2 s; compare: "
         "20 s, a recording to its end).",
         "S"});
    parser.addOption({"profile", "compare: profile to use instead of the shipped one.", "F"});
    declareEncoderOptions(parser);
    parser.addOption({"json", "Prints one JSON value."});
}

json textOrNull(const std::string& text) { return text.empty() ? json(nullptr) : json(text); }

const char* nameOf(SampleFormat format) noexcept { return format == SampleFormat::Int16 ? "int16" : "int32"; }

json streamJson(const SensorBoard& board, const Listened& heard, std::size_t i) {
    const auto& info = board.streams()[i];
    const auto& set = board.configuration(i);
    const auto& calibration = board.calibrations()[i];
    const auto& counts = heard.report.streams[i];
    auto scale = json::array();
    auto offset = json::array();
    for (const auto& column : set.columns) {
        scale.push_back(column.scale);
        offset.push_back(column.offset);
    }
    return {{"kind", tacto::nameOf(info.kind)},
            {"unit", symbolOf(info.unit)},
            {"channels", info.channels},
            {"format", nameOf(set.format)},
            {"rate_hz", info.rate_hz},
            {"measured_rate_hz", numberOrNull(heard.health[i].rate_hz)},
            {"samples", counts.samples},
            {"samples_lost", counts.lostSamples},
            {"gaps", counts.gaps},
            {"scale", std::move(scale)},
            {"offset", std::move(offset)},
            {"calibrated", calibration.calibrated},
            {"calibration_date", textOrNull(calibration.date)},
            {"calibration_reference", textOrNull(calibration.reference)},
            {"scale_uncertainty", calibration.uncertainty}};
}

/// Returns the hash of the profile in the board's encoder; empty if it was not asked to encode.
std::string encoderText(const SensorBoard& board) {
    const auto encoder = board.encoder();
    return encoder ? fmt::format("{:08x}", encoder->hash) : "";
}

json statusJson(const SensorBoard& board, const Listened& heard) {
    const auto& who = board.identity();
    auto streams = json::array();
    for (std::size_t i = 0; i < board.streams().size(); ++i) streams.push_back(streamJson(board, heard, i));
    auto line = json::object();
    const auto rows = sensorboard::rowsOf(heard.report);
    for (const auto& row : rows.rows()) line[row.key] = numberOrNull(row.value);
    const auto& own = heard.report.board;
    return {{"uri", who.uri},
            {"name", who.name},
            {"serial", who.serial},
            {"firmware", who.firmware},
            {"simulated", who.simulated},
            {"seconds", heard.seconds},
            {"streams", std::move(streams)},
            {"losses", rows.losses},
            {"line", std::move(line)},
            {"encoder_hash", textOrNull(encoderText(board))},
            {"board",
             {{"faulty_streams", own.faultyStreams},
              {"samples_lost", own.samplesLost},
              {"blocks_dropped", own.blocksDropped},
              {"frames_refused", own.framesRefused}}}};
}

std::string calibrationText(const sensorboard::StreamCalibration& calibration) {
    if (!calibration.calibrated) return "not calibrated";
    double worst = 0;
    for (const double one : calibration.uncertainty) worst = std::max(worst, one);
    return fmt::format("calibrated{}{}, scale ± {:.2g} % (k = 1)",
                       calibration.date.empty() ? "" : fmt::format(" {}", calibration.date),
                       calibration.reference.empty() ? "" : fmt::format(" ({})", calibration.reference), worst * 100);
}

void printText(const SensorBoard& board, const Listened& heard) {
    const auto& who = board.identity();
    TextTable table({"", ""});
    table.add({"sensor board", fmt::format("{} {}{}", who.name, who.serial, who.simulated ? "  (simulated)" : "")});
    table.add({"firmware", who.firmware});
    for (std::size_t i = 0; i < board.streams().size(); ++i) {
        const auto& info = board.streams()[i];
        table.add({std::string(tacto::nameOf(info.kind)),
                   fmt::format("{} × {} in {}, {:g} Hz (measured: {:.2f} Hz); {}", info.channels,
                               nameOf(board.configuration(i).format), symbolOf(info.unit), info.rate_hz,
                               heard.health[i].rate_hz, calibrationText(board.calibrations()[i]))});
    }
    if (board.encoder()) table.add({"encoder", "encodes by a profile with hash " + encoderText(board)});
    const auto& report = heard.report;
    const auto losses = sensorboard::lossesOf(report);
    table.add(
        {"listened", fmt::format("{:.1f} s: {}", heard.seconds, losses == 0 ? "nothing lost" : "something was lost")});
    table.print();
    TextTable counts({"", ""});
    const auto known = sensorboard::rowsOf(report);
    for (const auto& row : known.rows()) {
        counts.add({row.name, std::isfinite(row.value)
                                  ? fmt::format("{:.6g}{}{}", row.value, *row.unit != '\0' ? " " : "", row.unit)
                                  : "not known yet"});
    }
    if (report.board.faultyStreams != 0) counts.addLine("the board reports that one of its sensors does not answer");
    say("\n");
    counts.print();
}

int runSensor(const QCommandLineParser& parser) {
    const auto given = parser.positionalArguments();
    if (given.isEmpty()) return usage("sensor: status or compare is missing");
    const bool compares = given.front() == "compare";
    if (!compares && given.front() != "status")
        return usage(
            fmt::format("sensor: there is no \"{}\"; status or compare is expected", given.front().toStdString()));
    if (!compares && (parser.isSet("profile") || encoderOptionsGiven(parser)))
        return usage("sensor status: --profile, --load and what the board drives are for compare");
    if (!compares && given.size() > 2)
        return usage(
            fmt::format("sensor status: one URI is expected, and \"{}\" is a second one", given.at(2).toStdString()));
    const auto seconds = parser.isSet("seconds") ? numberOption(parser, "seconds")
                                                 : Result<double>(compares ? kSecondsCompared : kSecondsUsual);
    if (!seconds) return failWith(seconds.error());
    if (!(*seconds >= kMinSeconds && *seconds <= kMaxSeconds))
        return usage(fmt::format("--seconds is {}; {} to {} s is expected", *seconds, kMinSeconds, kMaxSeconds));
    if (compares) return compareSensor(parser, *seconds);
    const auto uri = DeviceUri::parse(given.size() == 2 ? given.at(1).toStdString() : std::string("sensor:"));
    if (!uri) return failWith(uri.error());
    if (uri->scheme != "sensor")
        return usage(fmt::format("\"{}\" is not a sensor board; sensor:, sensor:SERIAL or sensor:?tty=PATH is expected",
                                 uri->text()));
    const SignalStop interrupts;
    const SteadyClock clock;
    const auto board = openSensorBoard(sensorBoardPorts(), *uri, clock);
    if (!board) return failWith(board.error());
    const auto heard = listenTo(**board, Seconds(*seconds), interrupts);
    if (!heard) return failWith(heard.error());
    if (parser.isSet("json"))
        printJson(statusJson(**board, *heard));
    else
        printText(**board, *heard);
    return kDone;
}

}  // namespace

const Command kSensor{
    "sensor",
    "{status [URI] [--seconds S] [--json] | compare RECORDING|URI [--profile F] [--load OHM [--device URI] "
    "[--source KIND] [--largest X] [--step X]] [--seconds S] [--json]}",
    "A sensor board by hand: its identity, settings, calibration, rates, clock drift and losses; its "
    "own encoder beside the bench's",
    declareSensor, runSensor};

}  // namespace tacto::cli
