#include "app/gui/scope/CapturePipe.h"

#include <QFileInfo>
#include <cmath>
#include <utility>

#include "app/gui/scope/ScopeExport.h"
#include "app/run/CaptureFormatsList.h"

namespace tacto::gui {

namespace {

constexpr int kMaxPending = 8;

}  // namespace

CapturePipe::CapturePipe(QObject* parent) : QObject(parent) { thread_.setMaxThreadCount(1); }

CapturePipe::~CapturePipe() {
    wantedOpen_ = 0;
    reading_.request_stop();
    thread_.clear();
    thread_.waitForDone();
}

void CapturePipe::setAverage(std::size_t captures) {
    thread_.start([this, captures] { average_.setCaptures(captures); });
}

void CapturePipe::beginAnew() {
    gap_ = true;
    ++epoch_;
    thread_.start([this] { average_.clear(); });
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
    thread_.start([this, capture = std::move(capture), source, math = mathOptions_, follows, ours, epoch = epoch_,
                   mask = ours ? mask_ : nullptr]() mutable {
        std::optional<MaskCheck> judged;
        if (mask && !capture->untriggered) judged = mask->check(*capture);
        const bool averages = ours && average_.captures() > 1 && std::isfinite(capture->trigger_s);
        if (averages) capture = average_.add(std::move(capture));
        auto shown = std::const_pointer_cast<ShownCapture>(prepareCapture(std::move(capture), {}, math));
        shown->source = source;
        shown->mask = std::move(judged);
        shown->judgedBy = mask;
        shown->follows = follows;
        shown->averaged = averages ? average_.count() : 0;
        QMetaObject::invokeMethod(
            this,
            [this, shown, of = ours ? epoch : 0] {
                --pending_;
                if (of == 0 || of == epoch_) emit prepared(shown);
            },
            Qt::QueuedConnection);
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
    thread_.start([this, number, path, math = mathOptions_, stop = reading_.get_token()] {
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
        const auto why = read ? QString() : QString::fromStdString(read.error().message);
        QMetaObject::invokeMethod(
            this,
            [this, number, shown, why] {
                if (wantedOpen_ != number) return;
                opening_ = false;
                emit openingChanged();
                if (shown) {
                    emit prepared(shown);
                } else {
                    emit failed(tr("The capture could not be opened: %1. The picture stays.").arg(why));
                }
            },
            Qt::QueuedConnection);
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
    thread_.start([this, shown, math = mathOptions_] {
        const auto again = withMath(*shown, math);
        QMetaObject::invokeMethod(
            this, [this, again] { emit recalculated(again); }, Qt::QueuedConnection);
    });
}

void CapturePipe::save(const ShownPtr& shown, double from_s, double to_s, const QString& path) {
    if (!shown) return;
    thread_.start([this, shown, from_s, to_s, path] {
        const auto wrong = saveData(*shown, from_s, to_s, path);
        QMetaObject::invokeMethod(
            this,
            [this, wrong, path] {
                if (wrong) {
                    emit failed(*wrong);
                } else {
                    emit saved(path);
                }
            },
            Qt::QueuedConnection);
    });
}

}  // namespace tacto::gui

#include "moc_CapturePipe.cpp"
