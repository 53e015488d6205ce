// LaneLegend.h - the lanes of an oscilloscope by their colour: a line, the letter and what a division is.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QColor>
#include <QWidget>
#include <vector>

#include "app/gui/scope/model/ScopeModel.h"

namespace tacto::gui {

class LaneLegend final : public QWidget {
    Q_OBJECT
public:
    /// `model` outlives this.
    explicit LaneLegend(const ScopeModel& model, QWidget* parent);
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    struct Entry {
        QString words;  ///< "V 20 V/div"
        QColor line, ink;
        bool operator==(const Entry&) const = default;
    };
    void follow();

    const ScopeModel& model_;
    std::vector<Entry> entries_;
};

}  // namespace tacto::gui
