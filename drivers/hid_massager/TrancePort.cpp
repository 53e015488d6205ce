#include "drivers/hid_massager/TrancePort.h"

#include "drivers/hid_massager/WatchdogProcess.h"

namespace tacto::hid {

namespace {
constexpr UsbRequest kSpeed{0x43, 1, 0, 0};
}

VibrationReports tranceReports() {
    VibrationReports reports;
    reports.start = {0, 0};
    reports.stop = {0, 0};
    reports.fields = {{8, 8, ByteOrder::Little, 0, 255, VibrationRole::Intensity}};
    return reports;
}

Result<std::unique_ptr<HidPort>> TrancePort::open(std::shared_ptr<UsbContext> context, const UsbDeviceInfo& info) {
    auto control = UsbControl::open(std::move(context), info, kSpeed);
    if (!control) return failure(control);
    return std::unique_ptr<HidPort>(new TrancePort(std::move(*control)));
}

Result<std::size_t> TrancePort::write(std::span<const std::uint8_t> report) {
    if (report.size() != 2) {
        return fail(ErrorCode::InvalidArgument,
                    "Trance Vibrator: a report of {} bytes; expected 2: a 0, then the speed", report.size());
    }
    if (auto sent = control_->send(report[1], kTimeout); !sent) return failure(sent);
    return report.size();
}

Result<std::size_t> TrancePort::feature(std::span<std::uint8_t> /*report*/) {
    return fail(ErrorCode::Unsupported, "Trance Vibrator: it has no feature reports");
}

Result<std::unique_ptr<Watchdog>> TrancePort::watch(std::span<const std::uint8_t> stop) {
    StopWay way;
    way.kind = StopWay::Kind::Usb;
    way.node = control_->info().node();
    way.bytes = {kSpeed.type, kSpeed.request, stop[1], 0, 0, 0, 0, 0};
    return WatchdogProcess::start(way);
}

bool TrancePort::stopNow() noexcept {
    control_->sendUrgent(0);
    return true;
}

}  // namespace tacto::hid
