#include "app/gui/scope/model/CapturePipe.h"

#include <QFileInfo>
#include <cmath>
#include <utility>

#include "app/gui/scope/model/ScopeExport.h"
#include "app/run/CaptureFormatsList.h"

namespace tacto::gui {

namespace {

constexpr int kMaxPending = 8;

struct Opened {
    ShownPtr shown;
    QString why;  ///< it could not be
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

void CapturePipe::beginAnew() {
    gap_ = true;
    ++epoch_;
    work_.start([this] { average_.clear(); });
}

void CapturePipe::take(std::shared_ptr<const Capture> capture, const QString& source) {
    if (!capture || capture->samples() == 0 || !(capture->rate_hz > 0)) return;
    if (pending_ >= kMaxPending) {
        ++skipped_;
        gap_ = true;
        return;
    }
    ++pending_;
    const bool follows = !std::exchange(gap_, false);
    const bool ours = source.isEmpty();
    auto prepare = [this, capture = std::move(capture), source, math = mathOptions_, follows, ours,
                    mask = ours ? mask_ : nullptr, trigger = ours ? trigger_ : std::nullopt,
                    asked = ours ? asked_ : std::nullopt,
                    taken = ours ? QDateTime::currentDateTime() : QDateTime()]() mutable -> ShownPtr {
        if (trigger) capture = triggeredAtCrossing(std::move(capture), *trigger);
        std::optional<MaskCheck> judged;
        if (mask && !capture->untriggered) judged = mask->check(*capture);
        const bool averages = ours && average_.captures() > 1 && std::isfinite(capture->trigger_s);
        if (averages) capture = average_.add(std::move(capture));
        auto shown = std::const_pointer_cast<ShownCapture>(prepareCapture(std::move(capture), {}, math));
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
                prepareCapture(std::make_shared<const Capture>(std::move(read->capture)), {}, math));
            its->source = QFileInfo(path).fileName();
            // Says what is not evident: which instrument's table it was taken for.
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

}  // namespace tacto::gui

#include "moc_CapturePipe.cpp"
