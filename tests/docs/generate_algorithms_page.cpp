// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Fills the tables of docs/algorithms.md, between "<!-- table NAME -->" and "<!-- end -->", and
// draws its plot.
//   usage: generate_algorithms_page PAGE      prints the page with new tables
//          generate_algorithms_page --plot    prints the plot as SVG
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <string>

#include "tests/docs/algorithm_figures.hpp"

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: generate_algorithms_page PAGE | --plot\n", stderr);
        return 2;
    }
    if (std::string(argv[1]) == "--plot") {
        std::cout << figures::block_plot(figures::block_rows());
        return 0;
    }
    std::ifstream page(argv[1]);
    std::map<std::string, std::string> tables = {
        {"work", figures::work_table()},
        {"float-coverage", figures::float_coverage_table()},
        {"float-values", figures::float_table()},
        {"block", figures::block_table(figures::block_rows())}};
    bool is_replaced = false;
    for (std::string line; std::getline(page, line);) {
        const std::string begin = "<!-- table ";
        if (line == "<!-- end -->") {
            is_replaced = false;
        }
        if (!is_replaced) {
            std::cout << line << '\n';
        }
        if (line.starts_with(begin)) {
            const std::string name =
                line.substr(begin.size(), line.find(' ', begin.size()) - begin.size());
            const auto table = tables.find(name);
            if (table == tables.end()) {
                std::fprintf(stderr, "no table is called '%s', or it stands twice\n", name.c_str());
                return 3;
            }
            std::cout << table->second;
            tables.erase(table);
            is_replaced = true;
        }
    }
    for (const auto& [name, text] : tables) {
        std::fprintf(stderr, "the page has no place for the table '%s'\n", name.c_str());
        return 3;
    }
    return page.bad() || is_replaced ? 3 : 0;
}
