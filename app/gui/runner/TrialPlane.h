// TrialPlane.h - trials as points in the plane of their two features, while they come: amplitude and interval of
// trains, or the vibration and the taxel feature of a fingertip that slides.
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
    /// Adds a title as high as the title of a CaptureStrip beside it: their frames begin on one line.
    void addTitle();
    void setSimulated(bool simulated) { showWatermark(*watermark_, simulated); }
    /// A trial as record.trial() was given it; one without both features is counted and not drawn. A slide of a
    /// fingertip without taxels is drawn over its number.
    void add(const nlohmann::json& trial);
    [[nodiscard]] Features features() const { return features_; }
    [[nodiscard]] int trials() const { return trials_; }
    [[nodiscard]] int drawn() const { return drawn_; }
    /// Every condition's name stands at its points; else a legend above the plot names them.
    [[nodiscard]] bool namedInPlace() const { return !conditions_.empty() && !legend->visible(); }

private:
    void colour();
    void sayTitle();
    void fit();
    void nameClusters();
    /// Beside its points and off everything else; nothing where there is no such place.
    [[nodiscard]] std::optional<QRectF> placeOf(const QSizeF& name, std::size_t cluster,
                                                const std::vector<QRectF>& taken) const;
    [[nodiscard]] QRectF pixelsOf(const QCPGraph& graph) const;
    Features features_ = Features::Trains;
    std::vector<std::pair<QString, QCPGraph*>> conditions_;
    std::vector<QCPItemText*> names_;  ///< the conditions' names, at their points; owned by the plot
    QCPItemText* watermark_ = nullptr;
    QCPItemText* empty_ = nullptr;
    QCPTextElement* title_ = nullptr;  ///< null without one
    int trials_ = 0;
    int drawn_ = 0;
};

}  // namespace tacto::gui
