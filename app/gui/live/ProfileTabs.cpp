#include "app/gui/live/ProfileTabs.h"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QScrollArea>
#include <QVBoxLayout>
#include <cmath>

#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/base/Text.h"

namespace tacto::gui {

ProfileTabs::ProfileTabs(QWidget* parent) : QTabWidget(parent) {
    for (int tab = 0; tab < kProfileTabs; ++tab)
        addTab(buildTab(static_cast<ProfileTab>(tab)), titleOf(static_cast<ProfileTab>(tab)));
}

QWidget* ProfileTabs::buildTab(ProfileTab tab) {
    auto* area = new QScrollArea(this);
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* page = new QWidget(area);
    auto* form = new QFormLayout(page);
    form->setFieldGrowthPolicy(QFormLayout::ExpandingFieldsGrow);
    for (const auto& field : profileForm()) {
        if (field.tab != tab) continue;
        auto row = buildRow(field, page);
        auto* holder = new QWidget(page);
        auto* column = new QVBoxLayout(holder);
        column->setContentsMargins(0, 0, 0, 0);
        column->setSpacing(0);
        auto* across = new QHBoxLayout;
        if (row.box != nullptr) {
            across->addWidget(row.box, 1);
        } else {
            across->addWidget(row.line);
            across->addSpacing(8);
            auto* range = new QLabel(field.range(), holder);
            setTone(*range, Tone::Quiet);
            across->addWidget(range, 1);
        }
        column->addLayout(across);
        column->addWidget(row.refusal);
        row.label->setBuddy(row.box != nullptr ? static_cast<QWidget*>(row.box) : row.line);
        form->addRow(row.label, holder);
        rows_.push_back(row);
    }
    area->setWidget(page);
    area->setMinimumWidth(page->sizeHint().width() + fontMetrics().averageCharWidth() * 4);
    return area;
}

ProfileTabs::Row ProfileTabs::buildRow(const ProfileField& field, QWidget* page) {
    Row row;
    row.field = &field;
    row.label = new QLabel(profileWords(field.label), page);
    row.refusal = new QLabel(page);
    row.refusal->setObjectName(QString("%1.refusal").arg(field.key));
    row.refusal->setWordWrap(true);
    row.refusal->hide();
    QWidget* input = nullptr;
    if (field.isChoice()) {
        input = row.box = new QComboBox(page);
        for (std::size_t i = 0; i < field.form.words.size(); ++i)
            row.box->addItem(profileWords(field.form.words[i]), qtext(field.stored->words[i]));
        connect(row.box, &QComboBox::currentIndexChanged, this, &ProfileTabs::edited);
    } else {
        input = row.line = new QLineEdit(page);
        row.line->setAlignment(Qt::AlignRight);
        row.line->setFixedWidth(fontMetrics().horizontalAdvance("000000000000"));
        connect(row.line, &QLineEdit::textChanged, this, &ProfileTabs::edited);
    }
    input->setObjectName(field.key);
    input->setToolTip(profileWords(field.tip));
    row.label->setToolTip(profileWords(field.tip));
    return row;
}

void ProfileTabs::goTo(const QString& key) {
    for (const auto& row : rows_) {
        if (row.field->key != key) continue;
        setCurrentIndex(int(row.field->tab));
        QWidget* input = row.box;
        if (row.line != nullptr) {
            row.line->selectAll();
            input = row.line;
        }
        input->setFocus();
    }
}

void ProfileTabs::fill(const nlohmann::json& document) {
    for (auto& row : rows_) {
        const auto& value = document.at(row.field->section()).at(row.field->key);
        if (row.box != nullptr)
            row.box->setCurrentIndex(row.box->findData(QString::fromStdString(value.get<std::string>())));
        else
            row.line->setText(value.is_number()
                                  ? QString::number(value.get<double>(), 'g', QLocale::FloatingPointShortest)
                                  : QString());
    }
}

std::optional<ProfileTabs::Refusal> ProfileTabs::read(nlohmann::json& document) const {
    for (const auto& row : rows_) {
        auto& value = document[row.field->section()][row.field->key];
        if (row.box != nullptr) {
            value = row.box->currentData().toString().toStdString();
            continue;
        }
        const auto text = row.line->text().trimmed();
        if (text.isEmpty() && row.field->stored->mayBeNull) {
            value = nullptr;
            continue;
        }
        const auto number = parseNumber(text.toStdString());
        if (!number || !std::isfinite(*number))
            return Refusal{row.field, tr("\"%1\" is not a number; %2 is expected").arg(text, row.field->range())};
        value = *number;
    }
    return std::nullopt;
}

void ProfileTabs::mark(const ProfileField* field, const QString& refusal) {
    for (auto& row : rows_) {
        const bool wrong = field == row.field;
        row.refusal->setText(wrong ? "⚠ " + refusal : QString());
        row.refusal->setVisible(wrong);
        auto amber = palette();
        amber.setColor(QPalette::WindowText, colours().amberText);
        row.refusal->setPalette(amber);
    }
    for (int tab = 0; tab < kProfileTabs; ++tab) {
        const bool wrong = field != nullptr && field->tab == static_cast<ProfileTab>(tab);
        setTabText(tab, titleOf(static_cast<ProfileTab>(tab)) + (wrong ? " ⚠" : ""));
    }
    enableWhatMatters();
}

void ProfileTabs::enableWhatMatters() {
    for (auto& row : rows_) {
        if (row.field->form.needs == nullptr) continue;
        const auto chosen = findChild<QComboBox*>(row.field->form.needs)->currentData().toString();
        QString needed = row.field->form.needsValue;
        const bool matters = needed.startsWith('!') ? chosen != needed.mid(1) : chosen == needed;
        // A refused field can always be corrected.
        row.line->setEnabled(matters || !row.refusal->text().isEmpty());
        row.label->setEnabled(row.line->isEnabled());
    }
}

}  // namespace tacto::gui

#include "moc_ProfileTabs.cpp"
