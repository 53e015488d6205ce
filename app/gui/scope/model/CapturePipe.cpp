#include "app/gui/scope/model/CapturePipe.h"

#include <QFileInfo>
#include <QObject>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "app/run/CaptureFormatsList.h"
#include "core/measure/CaptureFile.h"

namespace tacto::gui {

namespace {

constexpr int kMaxPending = 8;

struct Opened {
    ShownPtr shown;
    QString why;  ///< the reason if the capture could not be measured
};

}  // namespace

CapturePipe::CapturePipe(QObject* parent) : QObject(parent) {}

CapturePipe::~CapturePipe() {
    wantedOpen_ = 0;
    reading_.request_stop();
    work_.drop();
}

void CapturePipe::setAverage(std::size_t captures) {
    work_.start([this, captures] { average_.setCaptures(captures); });
}

void CapturePipe::setTrigger(const ScopeSettings& settings, const SampleTrigger& trigger) {
    trigger_ = searched(trigger.kind) ? std::nullopt : std::optional(settings);
    passesOver_ = searched(trigger.kind) || trigger.holdOff_s > 0;
    work_.start([this, trigger, unit = settings.triggerOnCurrent ? "A" : "V", samples = settings.samples,
                 before = settings.preTrigger] { search_.set(trigger, unit, samples, before); });
}

void CapturePipe::beginAnew() {
    gap_ = true;
    ++epoch_;
    work_.start([this] {
        average_.clear();
        search_.forget();
    });
}

void CapturePipe::take(std::shared_ptr<const Capture> capture, const QString& source) {
    if (!capture || capture->samples() == 0 || !(capture->rate_hz > 0)) return;
    if (pending_ >= kMaxPending) {
        ++skipped_;
        gap_ = true;
        return;
    }
    ++pending_;
    const bool ours = source.isEmpty();
    const bool follows = !std::exchange(gap_, false) && !(ours && passesOver_);
    auto prepare = [this, capture = std::move(capture), source, math = mathOptions_, follows, ours,
                    mask = ours ? mask_ : nullptr, trigger = ours ? trigger_ : std::nullopt,
                    asked = ours ? asked_ : std::nullopt,
                    taken = ours ? QDateTime::currentDateTime() : QDateTime()]() mutable -> ShownPtr {
        if (ours) capture = search_.take(std::move(capture));
        if (trigger) capture = triggeredAtCrossing(std::move(capture), *trigger);
        std::optional<MaskCheck> judged;
        if (mask && !capture->untriggered) judged = mask->check(*capture);
        const bool averages = ours && average_.captures() > 1 && std::isfinite(capture->trigger_s);
        if (averages) capture = average_.add(std::move(capture));
        auto shown = std::const_pointer_cast<ShownCapture>(prepareCapture(std::move(capture), math));
        shown->source = source;
        shown->taken = taken;
        shown->asked = asked;
        shown->mask = std::move(judged);
        shown->judgedBy = mask;
        shown->follows = follows;
        shown->averaged = averages ? average_.count() : 0;
        return shown;
    };
    work_.start(this, std::move(prepare), [this, of = ours ? epoch_ : 0](const ShownPtr& shown) {
        --pending_;
        if (of == 0 || of == epoch_) emit prepared(shown);
    });
}

void CapturePipe::open(const QString& path) {
    const auto number = ++openNumber_;
    wantedOpen_ = number;
    opening_ = true;
    percentRead_ = 0;
    reading_.request_stop();
    reading_ = std::stop_source();
    emit openingChanged();
    const auto work = [this, number, path, math = mathOptions_, stop = reading_.get_token()]() -> Opened {
        auto read = captureFormats()->read(path.toStdString(), {}, {[this](double part) { tellRead(part); }, stop});
        ShownPtr shown;
        if (read && wantedOpen_ == number) {
            auto its = std::const_pointer_cast<ShownCapture>(
                prepareCapture(std::make_shared<const Capture>(std::move(read->capture)), math));
            its->source = QFileInfo(path).fileName();
            // The source also names the instrument whose format was recognised.
            if (read->formatId != "csv") its->source += " (" + QString::fromStdString(read->formatName) + ")";
            its->warnings.insert(its->warnings.begin(), read->warnings.begin(), read->warnings.end());
            shown = its;
        }
        return {shown, read ? QString() : QString::fromStdString(read.error().message)};
    };
    work_.start(this, work, [this, number](const Opened& opened) {
        if (wantedOpen_ != number) return;
        opening_ = false;
        emit openingChanged();
        if (opened.shown) {
            emit prepared(opened.shown);
        } else {
            emit failed(tr("The capture could not be opened: %1.").arg(opened.why));
        }
    });
}

void CapturePipe::cancelOpen() {
    if (!opening_) return;
    wantedOpen_ = 0;
    reading_.request_stop();
    opening_ = false;
    emit openingChanged();
}

void CapturePipe::tellRead(double part) {
    const int percent = static_cast<int>(100 * part);
    if (percentRead_.exchange(percent) == percent) return;
    QMetaObject::invokeMethod(
        this,
        [this] {
            if (opening_) emit openingChanged();
        },
        Qt::QueuedConnection);
}

void CapturePipe::search(const ShownPtr& shown, const SampleTrigger& trigger, const QString& unit,
                         std::function<void(std::vector<double>)> then) {
    const auto seek = [capture = shown->capture, trigger, unit = unit.toStdString()] {
        const auto channel = std::ranges::find(capture->channels, unit, &CaptureChannel::unit);
        if (channel == capture->channels.end()) return std::vector<double>();
        return triggersIn(*channel, capture->rate_hz, trigger);
    };
    work_.start(this, seek, std::move(then));
}

void CapturePipe::recalculate(const ShownPtr& shown) {
    if (!shown) return;
    work_.start(
        this, [shown, math = mathOptions_] { return withMath(*shown, math); },
        [this](const ShownPtr& again) { emit recalculated(again); });
}

void CapturePipe::save(const ShownPtr& shown, double from_s, double to_s, const QString& path) {
    if (!shown) return;
    work_.start(
        this, [shown, from_s, to_s, path] { return saveData(*shown, from_s, to_s, path); },
        [this, path](const std::optional<QString>& wrong) {
            if (wrong) {
                emit failed(*wrong);
            } else {
                emit saved(path);
            }
        });
}

namespace {

constexpr double kCrossingReach = 1;  ///< samples: how precisely an oscilloscope states its trigger
constexpr double kSameMoment = 1e-3;  ///< share of a sample within which two moments are the same

/// Returns where |signal| rises through `level` nearest to `stated`, in samples from the start of the record.
std::optional<double> crossingNear(const std::vector<float>& samples, double level, double stated) {
    std::optional<double> nearest;
    const double size = static_cast<double>(samples.size());
    const auto first = static_cast<std::size_t>(std::clamp(std::floor(stated) - kCrossingReach, 0.0, size));
    const auto last = static_cast<std::size_t>(std::clamp(std::ceil(stated) + kCrossingReach, -1.0, size - 1) + 1);
    for (std::size_t i = first + 1; i < last; ++i) {
        const auto before = static_cast<double>(samples[i - 1]), after = static_cast<double>(samples[i]);
        if (!(std::abs(before) < level) || !(std::abs(after) >= level)) continue;
        const double at = static_cast<double>(i - 1) + (std::copysign(level, after) - before) / (after - before);
        if (!nearest || std::abs(at - stated) < std::abs(*nearest - stated)) nearest = at;
    }
    return nearest;
}

}  // namespace

std::shared_ptr<const Capture> triggeredAtCrossing(std::shared_ptr<const Capture> capture,
                                                   const ScopeSettings& settings) {
    if (!std::isfinite(capture->trigger_s) || !(settings.triggerLevel > 0)) return capture;
    const auto* unit = settings.triggerOnCurrent ? "A" : "V";
    const auto source = std::find_if(capture->channels.begin(), capture->channels.end(),
                                     [unit](const CaptureChannel& channel) { return channel.unit == unit; });
    if (source == capture->channels.end()) return capture;
    const double stated = (capture->trigger_s - capture->start_s) * capture->rate_hz;
    const auto at = crossingNear(source->samples, settings.triggerLevel, stated);
    if (!at || std::abs(*at - stated) > kCrossingReach || std::abs(*at - stated) < kSameMoment) return capture;
    auto moved = std::make_shared<Capture>(*capture);
    moved->trigger_s = moved->start_s + *at / moved->rate_hz;
    return moved;
}

std::optional<QString> saveData(const ShownCapture& shown, double from_s, double to_s, const QString& path) {
    const auto& whole = *shown.capture;
    const auto index = [&](double t) {
        const double at = std::ceil((t - whole.start_s) * whole.rate_hz - 1e-6);
        return static_cast<std::ptrdiff_t>(std::clamp(at, 0.0, static_cast<double>(whole.samples())));
    };
    const auto first = index(from_s), last = index(to_s);
    if (first >= last) return QObject::tr("No data were saved: no sample is on the screen.");
    Capture part;
    part.rate_hz = whole.rate_hz;
    part.start_s = whole.start_s + static_cast<double>(first) / whole.rate_hz;
    for (const auto& trace : shown.traces) {
        CaptureChannel channel;
        channel.name = trace->key.section('/', 1).toStdString();
        channel.unit = trace->unit.toStdString();
        channel.samples.assign(trace->samples->begin() + first, trace->samples->begin() + last);
        part.channels.push_back(std::move(channel));
    }
    if (const auto written = writeCapture(path.toStdString(), part); !written) {
        return QObject::tr("%1. An existing file of that name was not changed.")
            .arg(QString::fromStdString(written.error().message));
    }
    return {};
}

}  // namespace tacto::gui

#include "moc_CapturePipe.cpp"
