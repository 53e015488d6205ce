#include "app/gui/controller/OpenBench.h"

namespace tacto::gui {

std::shared_ptr<const OpenBench> describeBench(const OpenedBench& opened) {
    auto open = std::make_shared<OpenBench>();
    open->about = opened.about;
    open->session = opened.files.session;
    auto& bench = *opened.bench;
    auto& devices = bench.devices();
    if (devices.sensor) open->streams.assign(devices.sensor->streams().begin(), devices.sensor->streams().end());
    if (devices.stimulator) open->source = devices.stimulator->traits();
    if (devices.stimulator)
        open->output = devices.stimulator->identity();
    else if (devices.massager)
        open->output = devices.massager->identity();
    if (devices.oscilloscope) open->scope = devices.oscilloscope->traits();
    open->paced = bench.clock().isVirtual();
    open->surfaces = devices.surface != nullptr;
    open->untriggered = bench.canCaptureUntriggered();
    return open;
}

namespace {

constexpr Seconds kLongestTurn{0.25};  // most bench time per turn, as stops and commands are handled between turns

}  // namespace

Result<std::unique_ptr<DrivenBench>> DrivenBench::open(Registry& registry, const LiveOrder& order,
                                                       const Conditions& conditions) {
    const BenchOrder wanted{.uris = order.uris,
                            .needed = order.needed,
                            .seed = order.seed,
                            .profile = order.profile,
                            .limits = conditions.limits,
                            .notes = order.notes,
                            .stops = conditions.stops,
                            .asked = conditions.asked,
                            .watched = conditions.watched};
    auto opened = openBench(wanted, registry, std::make_shared<BenchTap>());
    if (!opened) return failure(opened);
    return std::unique_ptr<DrivenBench>(new DrivenBench(*std::move(opened)));
}

void DrivenBench::serve(double speed) {
    opened_->bench->attend();
    if (!about_->paced) return;
    const auto now = std::chrono::steady_clock::now();
    const Seconds passed(std::chrono::duration<double>(now - std::exchange(servedAt_, now)).count() * speed);
    opened_->bench->idle(std::min(passed, kLongestTurn));
}

std::optional<Error> DrivenBench::takeRecordingFailure() {
    const auto failed = opened_->session->failed();
    if (!failed || std::exchange(recordingFailed_, true)) return {};
    return failed;
}

Result<void> DrivenBench::close() {
    opened_->bench.reset();
    static_cast<void>(opened_->endLsl());
    return opened_->session->close();
}

Result<void> DrivenBench::runScope(const ScopeSettings& settings, bool single,
                                   std::optional<Seconds> untriggeredAfter) {
    scope_ = settings;
    single_ = single;
    untriggeredAfter_ = untriggeredAfter;
    return repeatCapture();
}

void DrivenBench::stopScope() {
    scope_.reset();
    opened_->bench->cancelCaptures();
}

Result<void> DrivenBench::repeatCapture() {
    if (!scope_) return {};
    auto requested = opened_->bench->requestCaptures(1, *scope_, untriggeredAfter_);
    if (!requested) scope_.reset();
    return requested;
}

Result<std::shared_ptr<const Capture>> DrivenBench::takeCapture() {
    if (!scope_) return nullptr;
    auto taken = opened_->bench->takeCaptures();
    if (!taken) scope_.reset();
    if (!taken) return failure(taken);
    if (taken->empty()) return nullptr;
    if (single_) scope_.reset();
    return std::make_shared<const Capture>(std::move(taken->back()));
}

}  // namespace tacto::gui
