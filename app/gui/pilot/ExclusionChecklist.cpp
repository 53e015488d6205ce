#include "app/gui/pilot/ExclusionChecklist.h"

#include <QGridLayout>
#include <QLabel>
#include <QRadioButton>

#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

ExclusionChecklist::ExclusionChecklist(QWidget* parent) : QWidget(parent) {
    setObjectName("exclusionChecklist");
    setAccessibleName(tr("Exclusion checklist"));
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setHorizontalSpacing(scaledPx(16));
    grid->setVerticalSpacing(scaledPx(8));
    grid->setColumnStretch(0, 1);
    int row = 0;
    for (const auto& item : exclusionItems()) {
        auto* question = new QLabel(qtext(item.question), this);
        question->setTextFormat(Qt::PlainText);
        question->setWordWrap(true);
        grid->addWidget(question, row, 0);
        auto* group = new QButtonGroup(this);
        for (const auto answer : {kNo, kYes}) {
            auto* choice = new QRadioButton(answer == kYes ? tr("yes") : tr("no"), this);
            choice->setObjectName(qtext(item.key) + (answer == kYes ? "-yes" : "-no"));
            choice->setAccessibleName(tr("%1 %2").arg(qtext(item.question), choice->text()));
            group->addButton(choice, answer);
            grid->addWidget(choice, row, 1 + answer, Qt::AlignTop);
        }
        connect(group, &QButtonGroup::idToggled, this, &ExclusionChecklist::changed);
        groups_.push_back(group);
        ++row;
    }
}

void ExclusionChecklist::clear() {
    for (auto* group : groups_) {
        group->setExclusive(false);
        for (auto* choice : group->buttons()) choice->setChecked(false);
        group->setExclusive(true);
    }
}

std::vector<ExclusionAnswer> ExclusionChecklist::answers() const {
    std::vector<ExclusionAnswer> all;
    for (std::size_t i = 0; i < groups_.size(); ++i) {
        if (const int given = groups_[i]->checkedId(); given >= 0)
            all.push_back({std::string(exclusionItems()[i].key), given == kYes});
    }
    return all;
}

}  // namespace tacto::gui

#include "moc_ExclusionChecklist.cpp"
