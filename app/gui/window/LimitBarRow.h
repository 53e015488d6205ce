// LimitBarRow.h - limit bars beside each other, as many as fit: those that are nearest to their limits. One that is
// seen stays until another is clearly nearer. Where there is room for one alone it is narrow, and says its share.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QWidget>
#include <vector>

#include "app/gui/window/LimitBar.h"

namespace tacto::gui {

class LimitBarRow final : public QWidget {
public:
    LimitBarRow(const QStringList& titles, QWidget* parent);
    void show(std::size_t index, const std::optional<ExposureRow>& row, std::span<const LimitSet> sets = {}) {
        bars_[index]->show(row, sets);
    }
    void setTitle(std::size_t index, const QString& title) { bars_[index]->setTitle(title); }
    /// After the last show(): chooses which bars are seen.
    void arrange();
    /// In pixels: the least in which the nearest limit is shown.
    [[nodiscard]] int oneBarWidth() const;
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return {0, sizeHint().height()}; }

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    std::vector<LimitBar*> bars_;
    std::vector<LimitBar*> seen_;
};

}  // namespace tacto::gui
