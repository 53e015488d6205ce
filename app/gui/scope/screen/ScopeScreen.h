// ScopeScreen.h - draws a ScopeModel on ten by eight divisions: traces, numbers of the axes, and the overlay over the
// traces (ScopeOverlay).
#pragma once

#include <qcustomplot.h>

#include "app/gui/scope/model/ScopeModel.h"
#include "app/gui/scope/screen/EnvelopeGraph.h"
#include "app/gui/scope/screen/Graticule.h"
#include "app/gui/scope/screen/ScopeOverlay.h"

namespace tacto::gui {

class ScopeScreen final : public QCustomPlot {
    Q_OBJECT
public:
    /// `model` outlives this.
    explicit ScopeScreen(const ScopeModel& model, QWidget* parent = nullptr);

    /// Convert a pixel position to time and height on the model's axes.
    [[nodiscard]] double timeAt(double x) const;
    [[nodiscard]] double heightAt(double y) const;
    [[nodiscard]] double secondsPerPixel() const;
    [[nodiscard]] double divisionsPerPixel() const;
    [[nodiscard]] QRect area() const { return axisRect()->rect(); }
    [[nodiscard]] GripAt gripAt(const QPointF& pixel) const { return overlay_->at(pixel); }
    /// Sets the zoom box that the user is drawing, in pixels.
    void setBox(const std::optional<QRectF>& box);

    /// Shows a text in large letters over the traces; empty: no text.
    void setAlarm(const QString& alarm);
    [[nodiscard]] const QString& alarm() const noexcept { return alarm_; }
    /// Shows the bands of a mask behind the traces; null: no mask.
    void setMask(const std::shared_ptr<const CaptureMask>& mask);
    [[nodiscard]] const std::shared_ptr<const CaptureMask>& mask() const noexcept { return mask_; }

    /// Returns null if there is no such lane.
    [[nodiscard]] const EnvelopeGraph* graph(const QString& lane) const;
    [[nodiscard]] const OverlayState& overlay() const { return overlay_->state; }

protected:
    void resizeEvent(QResizeEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;

private:
    /// Owned by the plot.
    struct Graphs {
        EnvelopeGraph* newest = nullptr;
        std::vector<EnvelopeGraph*> behind;
    };
    void takeTraces();
    void restyle();
    void apply();
    void applyAxes();
    void numberAxis(QCPAxis& axis, RoundTicker& ticker, const ScopeLane* lane, bool shared) const;
    void fillOverlay();
    void refreshOverlay();

    const ScopeModel& model_;
    std::map<QString, Graphs> graphs_;
    std::optional<QRectF> box_;
    QString alarm_;
    std::shared_ptr<const CaptureMask> mask_;
    std::vector<MaskGraph*> bands_;  ///< owned by the plot
    QSharedPointer<RoundTicker> timeTicker_, leftTicker_, rightTicker_;
    QCPItemText* watermark_ = nullptr;  ///< owned by the plot
    RecordGround* ground_ = nullptr;    ///< owned by the plot
    ScopeOverlay* overlay_ = nullptr;   ///< owned by the plot
};

}  // namespace tacto::gui
