#include "app/gui/live/Spectrogram.h"

#include <algorithm>
#include <cmath>

namespace tacto::gui {

namespace {

constexpr double kWindow_s = 0.064;
constexpr double kHop_s = 0.032;
constexpr double kLow_hz = 5, kHigh_hz = 1000;
constexpr double kFloor_db = -80, kRoof_db = 20;  // of (m/s²)²/Hz: below is sensor noise, above a tap

/// Perceptually even and readable in grey: dark blue to yellow (points of the viridis family, as figures).
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
    map_->setTightBoundary(true);
}

void Spectrogram::begin(const StreamInfo* stream) {
    spectra_.clear();
    transform_.reset();
    map_->data()->clear();
    nextStart_s_ = -1;
    if (stream == nullptr || !(stream->rate_hz >= 100)) return;
    rate_hz_ = stream->rate_hz;
    axes_ = std::min(stream->channels, TapSample::kMaxChannels);
    length_ = static_cast<std::size_t>(std::lround(kWindow_s * rate_hz_));
    transform_ = std::make_unique<PowerSpectrum>(length_, axes_, rate_hz_);
    bins_ = transform_->bins(kLow_hz, std::min(kHigh_hz, rate_hz_ / 2));
    input_.assign(axes_, std::vector<double>(length_));
}

void Spectrogram::transformNew(const Series& series) {
    if (series.size() < length_) return;
    if (nextStart_s_ < series.time(0)) nextStart_s_ = series.time(0);
    for (;;) {
        const auto first = series.firstFrom(nextStart_s_);
        if (first + length_ > series.size()) return;
        Spectrum spectrum{series.time(first) + kWindow_s / 2, {}};
        bool whole = series.time(first + length_ - 1) - series.time(first) < 1.5 * kWindow_s;  // no gap inside
        for (std::size_t a = 0; a < axes_; ++a) {
            for (std::size_t i = 0; i < length_; ++i) {
                input_[a][i] = double(series.value(first + i, a));
                whole = whole && std::isfinite(input_[a][i]);
            }
        }
        if (whole) {
            std::vector<const double*> pointers;
            pointers.reserve(axes_);
            for (const auto& axis : input_) pointers.push_back(axis.data());
            transform_->transform(pointers);
            for (std::size_t bin = bins_.first; bin <= bins_.last; ++bin)
                spectrum.db.push_back(static_cast<float>(10 * std::log10(transform_->density(bin) + 1e-12)));
        }
        spectra_.push_back(std::move(spectrum));
        while (!spectra_.empty() && spectra_.front().t_s < spectra_.back().t_s - LiveHistory::kKept_s)
            spectra_.pop_front();
        nextStart_s_ += kHop_s;
    }
}

void Spectrogram::update(const Series& series, const QCPRange& window) {
    if (!transform_ || bins_.empty()) return;
    transformNew(series);
    const int rows = static_cast<int>(bins_.last - bins_.first + 1);
    const int columns = std::max(2, static_cast<int>(std::lround(window.size() / kHop_s)));
    auto* data = map_->data();
    data->setSize(columns, rows);
    data->setRange(window, QCPRange(double(bins_.first) * transform_->binWidth_hz(),
                                    double(bins_.last) * transform_->binWidth_hz()));
    data->fill(std::nan(""));
    for (auto it = spectra_.rbegin(); it != spectra_.rend() && it->t_s >= window.lower; ++it) {
        // Each covers its hop, so that rounding leaves no column between two.
        const auto columnOf = [&](double t) {
            return static_cast<int>(std::floor((t - window.lower) / window.size() * columns));
        };
        const int last = std::min(columns - 1, columnOf(it->t_s + kHop_s / 2));
        for (int column = std::max(0, columnOf(it->t_s - kHop_s / 2)); column <= last; ++column) {
            for (int row = 0; row < int(it->db.size()); ++row)
                data->setCell(column, row, double(it->db[std::size_t(row)]));
        }
    }
}

}  // namespace tacto::gui
