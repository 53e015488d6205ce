#include "drivers/sensor_board/BoardReport.h"

#include <limits>

namespace tacto::sensorboard {

namespace {

StreamCounts sumOf(const SensorBoardReport& report) noexcept {
    StreamCounts sum;
    for (const auto& stream : report.streams) sum += stream;
    return sum;
}

double asNumber(std::uint64_t count) noexcept { return static_cast<double>(count); }

}  // namespace

SensorBoardReport together(const SensorBoardReport& before, const SensorBoardReport& now) noexcept {
    SensorBoardReport sum = now;
    for (std::size_t i = 0; i < sum.streams.size(); ++i) sum.streams[i] += before.streams[i];
    sum.line.bytes += before.line.bytes;
    sum.line.frames += before.line.frames;
    sum.line.badCrc += before.line.badCrc;
    sum.line.malformed += before.line.malformed;
    sum.line.tooLong += before.line.tooLong;
    sum.dropped += before.dropped;
    sum.foreign += before.foreign;
    sum.encodedLost += before.encodedLost;
    sum.encodedLate += before.encodedLate;
    sum.clockSteps += before.clockSteps;
    return sum;
}

std::uint64_t lossesOf(const SensorBoardReport& report) noexcept {
    const auto sum = sumOf(report);
    return sum.lostSamples + sum.lostBlocks + sum.late + sum.unsound + report.line.bad() + report.dropped +
           report.foreign + report.encodedLost + report.encodedLate;
}

DeviceReport rowsOf(const SensorBoardReport& report) noexcept {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    const auto sum = sumOf(report);
    const bool known = report.driftKnown;
    DeviceReport rows;
    rows.losses = lossesOf(report);
    rows.add({"samples", "samples", asNumber(sum.samples), ""});
    rows.add({"samples_lost", "samples lost", asNumber(sum.lostSamples), ""});
    rows.add({"gaps", "gaps", asNumber(sum.gaps), ""});
    rows.add({"frames_lost", "frames lost", asNumber(sum.lostBlocks + report.encodedLost), ""});
    rows.add({"frames_unused", "frames late or unsound",
              asNumber(sum.late + sum.unsound + report.foreign + report.encodedLate), ""});
    rows.add({"crc_errors", "CRC errors", asNumber(report.line.badCrc), ""});
    rows.add({"malformed", "malformed frames", asNumber(report.line.malformed + report.line.tooLong), ""});
    rows.add({"bytes_dropped", "bytes read too late", asNumber(report.dropped), ""});
    rows.add({"drift_ppm", "clock drift", known ? report.drift_ppm : kUnknown, "ppm"});
    rows.add({"drift_uncertainty_ppm", "drift uncertainty, ±", known ? report.driftUncertainty_ppm : kUnknown, "ppm"});
    rows.add({"drift_span_s", "drift measured over", known ? report.driftSpan_s : kUnknown, "s"});
    rows.add({"delay_most_s", "delay, at most", report.delayMost_s, "s"});
    return rows;
}

}  // namespace tacto::sensorboard
