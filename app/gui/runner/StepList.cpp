#include "app/gui/runner/StepList.h"

#include <QVBoxLayout>

namespace tacto::gui {

StepList::StepList(const QStringList& steps, QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("Steps"));
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    for (const auto& step : steps) {
        auto* button = new QPushButton(this);
        button->setFlat(true);
        button->setAutoDefault(false);
        button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
        button->setToolTip(tr("Shows this step."));
        connect(button, &QPushButton::clicked, this, [this, index = int(rows_.size())] { emit chosen(index); });
        column->addWidget(button);
        rows_.push_back({step, {}, false, button});
    }
    write();
}

void StepList::setCurrent(int current) {
    current_ = current;
    write();
}

void StepList::setTroubled(int step, bool troubled) {
    auto& row = rows_.at(std::size_t(step));
    if (std::exchange(row.troubled, troubled) != troubled) write();
}

void StepList::setNote(int step, const QString& note) {
    auto& row = rows_.at(std::size_t(step));
    if (std::exchange(row.note, note) != note) write();
}

void StepList::write() {
    for (int i = 0; i < int(rows_.size()); ++i) {
        auto& row = rows_[std::size_t(i)];
        const auto* shape = row.troubled ? "⚠" : i < current_ ? "✔" : i == current_ ? "◔" : "○";
        const auto state = row.troubled    ? tr("to be mended")
                           : i < current_  ? tr("done")
                           : i == current_ ? tr("under way")
                                           : tr("to do");
        row.button->setText(QString("%1  %2").arg(shape, row.note.isEmpty() ? row.name : row.name + ": " + row.note));
        row.button->setAccessibleName(row.name);
        row.button->setAccessibleDescription(row.note.isEmpty() ? state : state + ", " + row.note);
        auto font = this->font();
        font.setBold(i == current_);
        row.button->setFont(font);
        // A button's text stands in the middle; a path reads from the left.
        row.button->setStyleSheet(
            "QPushButton { text-align: left; border: none; padding: 2px; }"
            "QPushButton:focus { border: 1px solid palette(highlight); padding: 1px; }");
    }
}

}  // namespace tacto::gui
