#include "app/gui/pilot/FactsCard.h"

#include <QVBoxLayout>

#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kCardPad = 12, kCardIcon = 16;
}

FactsCard::FactsCard(const QString& title, const QString& iconName, QWidget* parent)
    : QFrame(parent),
      icon_(iconName),
      picture_(new QLabel(this)),
      column_(new QVBoxLayout(this)),
      grid_(new QGridLayout) {
    setAccessibleName(title);
    column_->setContentsMargins(kCardPad, kCardPad / 2, kCardPad, kCardPad);
    column_->setSpacing(kCardPad / 2);
    auto* head = new QHBoxLayout;
    head->setSpacing(8);
    auto* words = new QLabel(title, this);
    setTextSize(*words, TextSize::Body, true);
    head->addWidget(picture_);
    head->addWidget(words, 1);
    column_->addLayout(head);
    grid_->setVerticalSpacing(8);
    grid_->setColumnStretch(1, 1);
    column_->addLayout(grid_);
    dress();
    onLookChange(*this, [this] { dress(); });
}

void FactsCard::setFacts(const std::vector<Fact>& facts) {
    if (facts == facts_) return;
    facts_ = facts;
    while (auto* item = grid_->takeAt(0)) {
        delete item->widget();
        delete item;
    }
    int row = 0;
    for (const auto& fact : facts_) {
        auto* name = new QLabel(fact.name, this);
        auto* value = new ElidedLabel(fact.value, this);
        for (auto* label : {name, static_cast<QLabel*>(value)}) label->setTextFormat(Qt::PlainText);
        setTextSize(*name, TextSize::Small);
        setTextSize(*value, TextSize::Small, fact.strong);
        if (!fact.strong) setTone(*value, Tone::Quiet);
        value->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
        value->setToolTip(fact.value);
        grid_->addWidget(name, row, 0);
        grid_->addWidget(value, row, 1);
        ++row;
    }
}

void FactsCard::setPicture(QWidget* picture) { column_->insertWidget(1, picture); }

void FactsCard::setWords(const QString& words) {
    if (words_ == nullptr) {
        words_ = new QLabel(this);
        words_->setWordWrap(true);
        setTextSize(*words_, TextSize::Small);
        setTone(*words_, Tone::Quiet);
        column_->addWidget(words_);
    }
    words_->setText(words);
}

void FactsCard::dress() {
    picture_->setPixmap(iconPixmap(icon_, colours().text, scaledPx(kCardIcon), devicePixelRatioF()));
}

}  // namespace tacto::gui

#include "moc_FactsCard.cpp"
