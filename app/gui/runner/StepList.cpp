#include "app/gui/runner/StepList.h"

#include <QHBoxLayout>

namespace tacto::gui {

StepList::StepList(const QStringList& steps, QWidget* parent) : QFrame(parent), steps_(steps) {
    setAccessibleName(tr("Steps"));
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    for (int i = 0; i < steps_.size(); ++i) {
        if (i > 0) row->addWidget(new QLabel("→", this));
        labels_.push_back(new QLabel(this));
        row->addWidget(labels_.back());
    }
    row->addStretch();
    setCurrent(0);
}

void StepList::setCurrent(int current) {
    current_ = current;
    for (int i = 0; i < int(labels_.size()); ++i) {
        auto* label = labels_[std::size_t(i)];
        const auto* shape = i < current ? "✔" : i == current ? "◔" : "○";
        label->setText(QString("%1 %2").arg(shape, steps_[i]));
        auto font = this->font();
        font.setBold(i == current);
        label->setFont(font);
        label->setEnabled(i <= current);
    }
}

}  // namespace tacto::gui
