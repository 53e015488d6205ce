// SpectrumPanel.h - the one-sided spectrum of the visible part of one lane, with a window function that the user
// chooses. Levels are the RMS of a sine at that frequency (corrected for the window's equivalent noise bandwidth),
// linear, logarithmic or in dB, over linear or logarithmic frequency. The peaks are named, and listed beside the plot.
//
// If there are more samples than one transform takes, the middle is used, and the panel says which part.
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
class QTableWidget;

namespace tacto::gui {

class ScopeModel;

/// RMS over frequency, from the first bin above 0 to half the sample rate.
struct Spectrum {
    struct Peak {
        double hz = 0;
        double rms = 0;
    };
    std::vector<double> hz;
    std::vector<double> rms;
    std::vector<Peak> peaks;  ///< highest first
    std::size_t samples = 0;  ///< number of samples transformed
    double bandwidth_hz = 0;  ///< equivalent noise bandwidth of one line
    QString note;             ///< why there is no spectrum, or which part of the samples it covers
};

enum class LevelScale { Logarithmic, Decibel, Linear };

class SpectrumPanel final : public QWidget {
    Q_OBJECT
public:
    static constexpr std::size_t kMaxSamples = std::size_t{1} << 17;
    static constexpr std::size_t kMaxPeaks = 10;  ///< in the list; the highest ones are named in the plot

    explicit SpectrumPanel(QWidget* parent = nullptr);
    ~SpectrumPanel() override;

    /// Shows the visible part of the chosen lane, and follows changes of the model while this panel is visible. `model`
    /// outlives this, or is disconnected first.
    void follow(const ScopeModel& model);
    [[nodiscard]] QString lane() const;
    [[nodiscard]] SpectralWindow window() const;
    [[nodiscard]] bool logarithmic() const;  ///< of the frequency
    [[nodiscard]] LevelScale levelScale() const;
    /// from_s and to_s are on the session's time base.
    void show(const TracePtr& trace, double from_s, double to_s, const QColor& colour);
    using QWidget::show;
    [[nodiscard]] const Spectrum& spectrum() const noexcept { return spectrum_; }
    /// The names of the peaks that have room for a name.
    [[nodiscard]] QStringList namedPeaks() const;

    void save(QSettings& settings) const;
    void restore(const QSettings& settings);

private:
    void showModel();
    void calculate(const Trace& trace, double from_s, double to_s);
    void findPeaks(const QString& unit);
    void draw();
    void setFrequencyAxis();
    void setLevelAxis();
    /// The place of a level on the axis.
    [[nodiscard]] double placed(double rms) const;
    void listPeaks();
    void fitLevels();
    void namePeaks();
    void restyle();

    const ScopeModel* model_ = nullptr;
    QComboBox* channel_;
    QComboBox* window_;
    QComboBox* levels_;
    QCheckBox* log_;
    QCheckBox* listed_;
    QLabel* note_;
    QCustomPlot* plot_;
    QTableWidget* list_;
    QCPGraph* graph_;
    QCPItemText* watermark_;
    QCPGraph* peaks_;
    std::vector<QCPItemText*> names_;  // the plot owns them
    Spectrum spectrum_;
    QString unit_;
    std::unique_ptr<PowerSpectrum> transform_;  // reused while length, window and rate stay the same
    double bins_ = 1;                           // equivalent noise bandwidth in bins
    double transformRate_hz_ = 0;
    SpectralWindow transformWindow_ = SpectralWindow::Hann;
    double shownTop_hz_ = 0;
    double levelFactor_ = 1;  ///< factor from unit_ to the unit of the level axis
    double highest_ = 0;      ///< highest level, in unit_
    QColor colour_;
};

}  // namespace tacto::gui
