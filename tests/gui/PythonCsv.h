// PythonCsv.h - reads tables of text with Python's csv module: an oracle that shares nothing with the program.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QStringList>
#include <gtest/gtest.h>
#include <vector>

namespace tacto::test {

struct SeparatedText {
    QString text;
    QChar separator;
};

/// Returns the rows of each text; nothing if Python cannot read them all.
inline std::vector<std::vector<QStringList>> readByPython(const std::vector<SeparatedText>& texts) {
    QJsonArray asked;
    for (const auto& [text, separator] : texts) asked.append(QJsonArray{text, QString(separator)});
    QProcess python;
    python.start("python3", {"-c",
                             "import csv,io,json,sys\n"
                             "print(json.dumps([list(csv.reader(io.StringIO(t,newline=''),delimiter=d,strict=True)) "
                             "for t,d in json.load(sys.stdin)]))"});
    python.write(QJsonDocument(asked).toJson());
    python.closeWriteChannel();
    EXPECT_TRUE(python.waitForFinished(60'000) && python.exitCode() == 0)
        << python.readAllStandardError().toStdString();
    std::vector<std::vector<QStringList>> all;
    for (const auto& table : QJsonDocument::fromJson(python.readAllStandardOutput()).array()) {
        auto& rows = all.emplace_back();
        for (const auto& row : table.toArray()) {
            auto& cells = rows.emplace_back();
            for (const auto& cell : row.toArray()) cells << cell.toString();
        }
    }
    EXPECT_EQ(all.size(), texts.size());
    all.resize(texts.size());
    return all;
}

}  // namespace tacto::test
