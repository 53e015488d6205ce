// Spectrogram.h - the acceleration's short-time Fourier transform over time: 64 ms Hann windows, axes summed, 5 Hz to
// 1 kHz, power density in dB.
//
// Thread-safety: the GUI thread.
#pragma once

#include <memory>
#include <qcustomplot.h>

#include "app/gui/live/LiveHistory.h"
#include "core/dsp/PowerSpectrum.h"

namespace tacto::gui {

class Spectrogram {
public:
    explicit Spectrogram(QCPAxisRect& axes);
    /// Another stream, or none (null): forgets everything.
    void begin(const StreamInfo* stream);
    /// Transforms what is new, and lays the picture over `window`.
    void update(const Series& series, const QCPRange& window);
    [[nodiscard]] std::size_t columns() const noexcept { return spectra_.size(); }

private:
    struct Spectrum {
        double t_s;
        std::vector<float> db;
    };
    void transformNew(const Series& series);

    QCPColorMap* map_;
    std::unique_ptr<PowerSpectrum> transform_;
    double rate_hz_ = 0;
    std::size_t axes_ = 0;
    std::size_t length_ = 0;
    BinRange bins_;
    double nextStart_s_ = 0;
    std::deque<Spectrum> spectra_;
    std::vector<std::vector<double>> input_;
};

}  // namespace tacto::gui
