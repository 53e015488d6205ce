// ScopeControls.h - the column at the side of the oscilloscope's screen: lanes, view, mask, trigger and record. The
// user's choices are kept in the settings.
#pragma once

#include <QScrollArea>

#include "app/gui/scope/panels/AcquisitionPanel.h"
#include "app/gui/scope/panels/LanePanel.h"
#include "app/gui/scope/panels/MaskPanel.h"
#include "app/gui/scope/panels/ViewPanel.h"

namespace tacto::gui {

class ScopeControls final : public QScrollArea {
    Q_OBJECT
public:
    /// `model` and `screen` outlive this.
    ScopeControls(ScopeModel& model, ScopeScreen& screen, QWidget* parent);

    [[nodiscard]] ViewPanel& view() const { return *view_; }
    [[nodiscard]] MaskPanel& mask() const { return *mask_; }
    [[nodiscard]] AcquisitionPanel& acquisition() const { return *acquisition_; }

    void save(QSettings& settings) const;
    void restore(const QSettings& settings);

    /// The column is always as wide as its contents.
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return {sizeHint().width(), fontMetrics().height() * 6}; }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    ViewPanel* view_;
    MaskPanel* mask_;
    AcquisitionPanel* acquisition_;
};

}  // namespace tacto::gui
