// TrialPlane.h - plot of the trials by their two features, as they arrive: amplitude and interval of trains, or
// vibration and taxel feature of a fingertip's slides.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <qcustomplot.h>
#include <vector>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

class TrialPlane final : public QCustomPlot {
    Q_OBJECT
public:
    enum class Features { Trains, Slides };

    explicit TrialPlane(QWidget* parent = nullptr);
    void begin(bool simulated, Features features = Features::Trains);
    /// Adds a title as high as that of a CaptureStrip next to the plot, so that both frames begin at the same height.
    void addTitle();
    void setSimulated(bool simulated) { showWatermark(*watermark_, simulated); }
    /// Adds a trial as passed to record.trial(); a trial without both features is counted but not drawn. A slide of a
    /// fingertip without taxels is drawn against its number.
    void add(const nlohmann::json& trial);
    /// Says why nothing is drawn, if that is so at the end of a run.
    void end();
    [[nodiscard]] Features features() const { return features_; }
    [[nodiscard]] int trials() const { return trials_; }
    [[nodiscard]] int drawn() const { return drawn_; }
    /// True if every condition's name is next to its points; otherwise a legend above the plot names them.
    [[nodiscard]] bool namedInPlace() const { return !conditions_.empty() && !legend->visible(); }

private:
    void colour();
    void sayTitle();
    void fit();
    void nameClusters();
    /// Returns a place next to the cluster's points that covers nothing else; nothing if there is none.
    [[nodiscard]] std::optional<QRectF> placeOf(const QSizeF& name, std::size_t cluster,
                                                const std::vector<QRectF>& taken) const;
    [[nodiscard]] QRectF pixelsOf(const QCPGraph& graph) const;
    Features features_ = Features::Trains;
    std::vector<std::pair<QString, QCPGraph*>> conditions_;
    std::vector<QCPItemText*> names_;  ///< the conditions' names next to their points; owned by the plot
    QCPItemText* watermark_ = nullptr;
    QCPItemText* empty_ = nullptr;
    QCPTextElement* title_ = nullptr;  ///< null if there is no title
    int trials_ = 0;
    int drawn_ = 0;
};

}  // namespace tacto::gui
