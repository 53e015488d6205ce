#include "app/gui/live/Spectrogram.h"

#include <algorithm>
#include <cmath>

#include "app/gui/theme/Text.h"

namespace tacto::gui {

namespace {

constexpr double kWindow_s = 0.064;
constexpr double kHop_s = 0.032;
constexpr double kLow_hz = 5, kHigh_hz = 1000;
constexpr double kFloor_db = -70, kRoof_db = 10;  // in dB of 1 (m/s²)²/Hz: below is sensor noise, above are taps
constexpr std::int64_t kColumns = static_cast<std::int64_t>(LiveHistory::kKept_s / kHop_s);

/// Returns an even colour scale from dark blue to yellow that works for all kinds of colour vision and in grey (points
/// of the viridis family, as in the figures).
QCPColorGradient gradient() {
    QCPColorGradient g;
    g.clearColorStops();
    const std::pair<double, QColor> stops[] = {{0.0, QColor(68, 1, 84)},
                                               {0.25, QColor(59, 82, 139)},
                                               {0.5, QColor(33, 145, 140)},
                                               {0.75, QColor(94, 201, 98)},
                                               {1.0, QColor(253, 231, 37)}};
    for (const auto& [place, colour] : stops) g.setColorStopAt(place, colour);
    g.setNanHandling(QCPColorGradient::nhTransparent);
    return g;
}

}  // namespace

Spectrogram::Spectrogram(QCPAxisRect& axes)
    : map_(new QCPColorMap(axes.axis(QCPAxis::atBottom), axes.axis(QCPAxis::atLeft))) {
    map_->setGradient(gradient());
    map_->setDataRange(QCPRange(kFloor_db, kRoof_db));
    map_->setInterpolate(false);
    map_->setTightBoundary(false);  // a cell is centred on its time and frequency
}

void Spectrogram::begin(const StreamInfo* stream) {
    transform_.reset();
    map_->data()->clear();
    next_ = 0;
    base_s_ = std::nan("");
    transformed_ = 0;
    top_hz_ = 0;
    if (stream == nullptr || !(stream->rate_hz >= 100)) return;
    absolute_ = stream->unit == StreamUnit::MetrePerSecondSquared;
    map_->setDataRange(QCPRange(kFloor_db, kRoof_db));
    rate_hz_ = stream->rate_hz;
    axes_ = std::min(stream->channels, TapSample::kMaxChannels);
    length_ = static_cast<std::size_t>(std::lround(kWindow_s * rate_hz_));
    transform_ = std::make_unique<PowerSpectrum>(length_, axes_, rate_hz_);
    top_hz_ = std::min(kHigh_hz, rate_hz_ / 2);
    bins_ = transform_->bins(kLow_hz, top_hz_);
    rows_ = bins_.empty() ? 0 : bins_.last - bins_.first + 1;
    db_.assign(static_cast<std::size_t>(kColumns) * rows_, 0.F);
    holds_.assign(static_cast<std::size_t>(kColumns), -1);
    input_.assign(axes_ * length_, 0.0);
    axisInput_.clear();
    for (std::size_t a = 0; a < axes_; ++a) axisInput_.push_back(input_.data() + a * length_);
}

void Spectrogram::transformNew(const Series& series) {
    if (series.size() < length_) return;
    const double half = 0.5 / rate_hz_;  // time stamps are rounded, so the nearest sample is taken
    const auto columnAtOrAfter = [&](double t) {
        return static_cast<Index>(std::ceil((t - half - base_s_) / kHop_s - 1e-9));
    };
    if (std::isnan(base_s_)) base_s_ = series.time(0);
    next_ = std::max(next_, columnAtOrAfter(series.time(0)));
    for (;;) {
        const double start = base_s_ + double(next_) * kHop_s;
        const auto first = series.firstFrom(start - half);
        if (first + length_ > series.size()) return;
        if (series.time(first) > start + kHop_s) {  // samples are missing: go on after the gap
            next_ = columnAtOrAfter(series.time(first));
            continue;
        }
        bool whole = series.time(first + length_ - 1) - series.time(first) < kWindow_s + 2 / rate_hz_;
        for (std::size_t a = 0; a < axes_; ++a) {
            auto* into = input_.data() + a * length_;
            double sum = 0;
            for (std::size_t i = 0; i < length_; ++i) sum += into[i] = double(series.value(first + i, a));
            const double mean = sum / double(length_);
            for (std::size_t i = 0; i < length_; ++i) into[i] -= mean;
            whole = whole && std::isfinite(sum);
        }
        keep(next_, whole);
        ++next_;
    }
}

void Spectrogram::keep(Index column, bool whole) {
    const auto slot = static_cast<std::size_t>(column % kColumns);
    holds_[slot] = whole ? column : -1;
    if (!whole) return;
    transform_->transform(axisInput_);
    ++transformed_;
    for (std::size_t row = 0; row < rows_; ++row)
        db_[slot * rows_ + row] = static_cast<float>(10 * std::log10(transform_->density(bins_.first + row) + 1e-12));
}

const float* Spectrogram::kept(Index column) const noexcept {
    if (column < 0) return nullptr;
    const auto slot = static_cast<std::size_t>(column % kColumns);
    return holds_[slot] == column ? db_.data() + slot * rows_ : nullptr;
}

double Spectrogram::densityAt_db(double t_s, double hz) const noexcept {
    if (!transform_ || rows_ == 0 || std::isnan(base_s_)) return std::nan("");
    const auto* column = kept(static_cast<Index>(std::lround((t_s - kWindow_s / 2 - base_s_) / kHop_s)));
    const auto bin = std::lround(hz / transform_->binWidth_hz());
    if (column == nullptr || bin < long(bins_.first) || bin > long(bins_.last)) return std::nan("");
    return double(column[std::size_t(bin) - bins_.first]);
}

QString Spectrogram::scaleText() const {
    const auto range = map_->dataRange();
    return QObject::tr("%1 to %2 dB re 1 %3")
        .arg(decimalText(range.lower, 0), decimalText(range.upper, 0), QString(absolute_ ? "(m/s²)²/Hz" : "count²/Hz"));
}

void Spectrogram::update(const Series& series, const QCPRange& window, int columns) {
    if (!transform_ || rows_ == 0) return;
    transformNew(series);
    if (std::isnan(base_s_)) return;
    // Columns stay on the transform's own grid, so that they do not flicker while the window moves.
    const double centre0 = base_s_ + kWindow_s / 2;
    const auto wanted = static_cast<Index>(window.size() / kHop_s) + 2;
    const Index stride = std::max<Index>(1, (wanted + columns - 1) / std::max(1, columns));
    const Index first = static_cast<Index>(std::floor((window.lower - centre0) / kHop_s / double(stride))) * stride;
    const int shown = static_cast<int>(wanted / stride + 1);
    auto* data = map_->data();
    data->setSize(shown, static_cast<int>(rows_));
    data->setRange(
        QCPRange(centre0 + double(first) * kHop_s, centre0 + double(first + (shown - 1) * stride) * kHop_s),
        QCPRange(double(bins_.first) * transform_->binWidth_hz(), double(bins_.last) * transform_->binWidth_hz()));
    float most = -300;
    for (int c = 0; c < shown; ++c) {
        const auto* column = kept(first + c * stride);
        for (int row = 0; row < int(rows_); ++row) {
            const float db = column != nullptr ? column[row] : std::nanf("");
            if (db > most) most = db;
            data->setCell(c, row, double(db));
        }
    }
    if (absolute_ || most < -200) return;
    // Counts have no absolute scale: the loudest value in the window sets the top.
    const double roof = 10 * std::ceil(double(most) / 10);
    map_->setDataRange(QCPRange(roof - (kRoof_db - kFloor_db), roof));
}

}  // namespace tacto::gui
