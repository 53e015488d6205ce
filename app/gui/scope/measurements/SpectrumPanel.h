// SpectrumPanel.h - the spectrum of what one lane shows on the screen, through a window of choice: one-sided, as the
// RMS that a sine of that frequency would have (the window's equivalent noise bandwidth is taken out), over linear or
// logarithmic frequency, with its peaks named.
//
// Where more samples come than fit into one transform, the middle is taken, and the panel says which part that is.
#pragma once

#include <QWidget>
#include <memory>

#include "app/gui/scope/model/Trace.h"
#include "core/dsp/PowerSpectrum.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QSettings;
class QCustomPlot;
class QCPGraph;
class QCPItemText;

namespace tacto::gui {

class ScopeModel;

/// RMS over frequency, from the first bin above 0 up to half the rate.
struct Spectrum {
    struct Peak {
        double hz = 0;
        double rms = 0;
    };
    std::vector<double> hz;
    std::vector<double> rms;
    std::vector<Peak> peaks;  ///< highest first
    std::size_t samples = 0;  ///< how many samples were transformed
    double bandwidth_hz = 0;  ///< equivalent noise bandwidth of a line
    QString note;             ///< why there is none, or which part of the samples it covers
};

class SpectrumPanel final : public QWidget {
    Q_OBJECT
public:
    static constexpr std::size_t kMaxSamples = std::size_t{1} << 17;
    static constexpr std::size_t kMaxPeaks = 6;

    explicit SpectrumPanel(QWidget* parent = nullptr);
    ~SpectrumPanel() override;

    /// Shows the chosen lane's part that is on the screen, and follows the model from now on while visible. `model`
    /// outlives this, or takes its leave with disconnect().
    void follow(const ScopeModel& model);
    [[nodiscard]] QString lane() const;
    [[nodiscard]] SpectralWindow window() const;
    [[nodiscard]] bool logarithmic() const;
    /// from..to on the session's time base.
    void show(const TracePtr& trace, double from_s, double to_s, const QColor& colour);
    using QWidget::show;
    [[nodiscard]] const Spectrum& spectrum() const noexcept { return spectrum_; }
    /// The peaks whose names have room, as they are written.
    [[nodiscard]] QStringList namedPeaks() const;

    void save(QSettings& settings) const;
    void restore(const QSettings& settings);

private:
    void showModel();
    void calculate(const Trace& trace, double from_s, double to_s);
    void findPeaks(const QString& unit);
    void draw();
    void setFrequencyAxis();
    void fitLevels();
    void namePeaks();
    void restyle();

    const ScopeModel* model_ = nullptr;
    QComboBox* channel_;
    QComboBox* window_;
    QCheckBox* log_;
    QLabel* note_;
    QCustomPlot* plot_;
    QCPGraph* graph_;
    QCPItemText* watermark_;
    QCPGraph* peaks_;
    std::vector<QCPItemText*> names_;  // enough for all peaks; owned by the plot
    Spectrum spectrum_;
    QString unit_;
    std::unique_ptr<PowerSpectrum> transform_;  // kept while length, window and rate stay
    double bins_ = 1;                           // equivalent noise bandwidth
    double transformRate_hz_ = 0;
    SpectralWindow transformWindow_ = SpectralWindow::Hann;
    double shownTop_hz_ = 0;
    double levelFactor_ = 1;  ///< factor from unit_ to the unit of the level axis
    double highest_ = 0;      ///< level on that axis
    QColor colour_;
};

}  // namespace tacto::gui
