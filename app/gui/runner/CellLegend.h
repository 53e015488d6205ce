// CellLegend.h - how to read a cell of the limits x loads, beside them: each kind of cell with its shape and words.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QWidget>
#include <vector>

namespace tacto::gui {

class CellLegend final : public QWidget {
    Q_OBJECT
public:
    explicit CellLegend(QWidget* parent);
    [[nodiscard]] QSize sizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    struct Kind {
        QString verdict;  ///< empty: not judged
        bool isNear;
        QString words;
    };
    std::vector<Kind> kinds_;
};

}  // namespace tacto::gui
