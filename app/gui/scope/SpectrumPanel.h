// SpectrumPanel.h - the spectrum of what one lane shows on the screen: Hann window, one-sided, as the RMS that a sine
// of that frequency would have.
//
// Of more samples than fit into one transform the middle is taken, and the panel says which part that is.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QWidget>
#include <memory>

#include "app/gui/scope/Trace.h"
#include "core/dsp/PowerSpectrum.h"

class QComboBox;
class QLabel;
class QCustomPlot;
class QCPGraph;
class QCPItemText;

namespace tacto::gui {

struct LaneInfo;

/// RMS over frequency, from the first bin above 0 up to half the rate.
struct Spectrum {
    std::vector<double> hz;
    std::vector<double> rms;
    std::size_t samples = 0;  ///< that were transformed
    QString note;             ///< why there is none, or of which part it is
};

class SpectrumPanel final : public QWidget {
    Q_OBJECT
public:
    static constexpr std::size_t kMaxSamples = std::size_t{1} << 17;

    explicit SpectrumPanel(QWidget* parent = nullptr);
    ~SpectrumPanel() override;

    void setLanes(const std::vector<LaneInfo>& lanes);
    [[nodiscard]] QString lane() const;
    /// from..to on the session's time base.
    void show(const TracePtr& trace, double from_s, double to_s, const QColor& colour);
    using QWidget::show;
    [[nodiscard]] const Spectrum& spectrum() const noexcept { return spectrum_; }

signals:
    void laneChosen();

protected:
    void changeEvent(QEvent* event) override;

private:
    void calculate(const Trace& trace, double from_s, double to_s);
    void draw(const QString& unit);

    QComboBox* channel_;
    QLabel* note_;
    QCustomPlot* plot_;
    QCPGraph* graph_;
    Spectrum spectrum_;
    std::unique_ptr<PowerSpectrum> transform_;  // kept while length and rate stay
    double transformRate_hz_ = 0;
    QColor colour_;
};

}  // namespace tacto::gui
