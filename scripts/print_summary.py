#!/usr/bin/env python3
"""Prints what a run's summary.json says as a short table, and where its files are."""
import argparse
import json
import os
import sys


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("directory", help="where the run's files are, or its summary.json")
    directory = parser.parse_args().directory
    if os.path.basename(directory) == "summary.json":
        directory = os.path.dirname(directory) or "."
    path = os.path.join(directory, "summary.json")
    try:
        with open(path) as file:
            s = json.load(file)
        if "energy_J" not in s:  # of a scene that was refused
            sys.exit(s["status"]["message"])
    except (OSError, ValueError, KeyError, TypeError) as error:
        sys.exit(f"{path}: cannot be read as the summary of a run: {error}")
    dimension = s["dimension"]
    newton = "N/m" if s["per_metre_of_width"] else "N"
    kinematics = "axisymmetric" if s["axisymmetric"] else "plane strain" if dimension == 2 else "3D"

    def number(value, scale=1.0, form="{:.4g}"):
        return "-" if value is None else form.format(value * scale)

    energy = s["energy_J"]
    rows = [
        ("scene", f"{s['scene']} ({kinematics})"),
        ("status", s["status"]["message"]),
        ("mesh", f"{s['cells']} cells, {s['elements']} elements, {s['nodes']} nodes"),
        ("time", f"{number(s['sim_time_s'], 1e3)} ms simulated in {s['steps']} steps, {number(s['wall_time_s'])} s of solving"),
        ("speed", f"{number(s['ns_per_element_step'])} ns per element and step"),
        ("time step", f"{number(s['time_step_s']['first'])} s at first, {number(s['time_step_s']['min'])} s at least, limited by {s['time_step_s']['limited_by']}"),
        ("largest plastic strain", number(s["plastic_strain"]["max"])),
        ("largest surface strain", number(s["surface_strain"]["max"]) + " (principal, logarithmic)"),
        ("thickness", f"{number(s['thickness_m']['initial'], 1e3)} mm at first, {number(s['thickness_m']['min'], 1e3)} mm at least"),
        ("largest thinning", number(s["thinning"]["max"], 100) + " %"),
    ]
    for damage in s.get("damage", []):
        critical = "" if damage["critical"] is None else f", critical {number(damage['critical'])}"
        rows.append((f"damage of {damage['body']}", f"{number(damage['max'])}{' Pa' if damage['unit'] == 'Pa' else ''} ({damage['criterion']}{critical})"))
    for limit in s.get("forming_limit", []):
        rows.append((f"forming limit of {limit['body']}", f"{number(limit['max'], 100)} % of it at most; beyond it {number(limit['beyond'], 100)} % of the sheet"))
    for tool in s["tools"]:
        force = tool["peak_force"]
        rows.append((f"peak force on {tool['name']}", "(" + ", ".join(number(f) for f in force) + f") {newton}"))
        if tool["peak_radial_force"] is not None:
            rows.append((f"peak radial force on {tool['name']}", number(tool["peak_radial_force"]) + " N outward, summed around the circle"))
        if tool["turned_deg"] is not None:
            rows.append((f"{tool['name']} turned", number(tool["turned_deg"]) + " deg about its axle"))
        if tool["stopped_s"] is not None:
            rows.append((f"{tool['name']} stopped", f"at {number(tool['stopped_s'], 1e3)} ms, under its stop_force"))
    spring = s.get("springback") or {}
    if spring.get("angle_deg_released") is not None:
        rows.append(("angle", f"{number(spring['angle_deg_formed'], 1, '{:.2f}')} deg formed, {number(spring['angle_deg_released'], 1, '{:.2f}')} deg released: springback {number(spring['change_deg'], 1, '{:.2f}')} deg"))
    if energy.get("kinetic_over_internal_forming") is not None:
        rows.append(("kinetic over internal", number(energy["kinetic_over_internal_forming"], 100) + " % (the most while forming)"))
    rows += [
        ("energy balance", f"{number(energy['balance_error'], 100)} % of the work is unaccounted for"),
        ("contact", f"{s['contact']['crossings']} crossings, {s['contact']['halvings']} halved steps, smallest gap {number(s['contact']['min_gap_over_h0'])} h0"),
    ]
    if s["contact"].get("sweeps_per_step") is not None:
        rows.append(("contact forces", f"{number(s['contact']['sweeps_per_step'])} sweeps a step, {number(s['contact']['share_at_max_sweeps'], 100)} % of the steps ended at contact.max_sweeps"))
    width = max(len(name) for name, _ in rows)
    try:
        for name, text in rows:
            print(f"  {name:<{width}}  {text}")
        print("\nfiles")
        for name in sorted(os.listdir(directory)):
            print("  " + os.path.join(directory, name))
        sys.stdout.flush()
    except BrokenPipeError:  # who reads wants no more, as head does
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return 0 if s["status"]["code"] == 1 else 1


if __name__ == "__main__":
    sys.exit(main())
