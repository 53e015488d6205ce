// Spectrogram.h - short-time Fourier transform of the acceleration over time: 64 ms Hann windows every 32 ms with their
// mean (gravity) removed, axes summed, 5 Hz to 1 kHz, power density in dB.
//
// Bounded: a ring of one minute of columns; after begin() memory is allocated only for a longer window.
#pragma once

#include <cstdint>
#include <memory>
#include <qcustomplot.h>
#include <vector>

#include "app/gui/live/LiveHistory.h"
#include "core/dsp/PowerSpectrum.h"

namespace tacto::gui {

class Spectrogram {
public:
    explicit Spectrogram(QCPAxisRect& axes);
    /// Starts another stream, or none (null), and forgets everything.
    void begin(const StreamInfo* stream);
    /// Transforms new samples, and scales the picture to `window`, at most `columns` wide.
    void update(const Series& series, const QCPRange& window, int columns);
    /// Upper end of the picture in Hz; 0 without a stream.
    [[nodiscard]] double top_hz() const noexcept { return top_hz_; }
    /// Number of windows transformed since begin().
    [[nodiscard]] std::int64_t transformed() const noexcept { return transformed_; }
    /// Returns the values of the darkest and the brightest colour.
    [[nodiscard]] QString scaleText() const;
    /// Returns the power density at a place in the picture in dB; NaN outside the picture.
    [[nodiscard]] double densityAt_db(double t_s, double hz) const noexcept;

private:
    using Index = std::int64_t;  // number of a column; its window begins at base_s_ + index · hop
    void transformNew(const Series& series);
    void keep(Index column, bool whole);
    [[nodiscard]] const float* kept(Index column) const noexcept;

    QCPColorMap* map_;
    std::unique_ptr<PowerSpectrum> transform_;
    bool absolute_ = false;  // in m/s²: a colour always means the same value
    double rate_hz_ = 0;
    double top_hz_ = 0;
    std::size_t axes_ = 0;
    std::size_t length_ = 0;
    BinRange bins_;
    std::size_t rows_ = 0;
    double base_s_ = 0;
    Index next_ = 0;
    std::int64_t transformed_ = 0;
    std::vector<float> db_;      // ring of kColumns × rows_
    std::vector<Index> holds_;   // the column held in each slot; -1: none
    std::vector<double> input_;  // size axes_ × length_
    std::vector<const double*> axisInput_;
};

}  // namespace tacto::gui
