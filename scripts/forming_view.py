#!/usr/bin/env python3
"""Opens rviz on a run: a node for launch files.

usage: forming_view.py fit | VIEW [TOPICS [FRAME]] [options of rviz]

VIEW is one of the shipped views, forming (a section in x-y) or forming_3d, shown at once. fit waits for the first
run on the topics and frames its bodies, the legend beside them, in the one or the other by the run's dimension.
TOPICS is the namespace of the topics, forming_server unless given, in the namespace of the node; FRAME the frame of
the bodies, forming_world unless given.
"""
import os
import re
import sys

import rospkg
import rospy
import yaml

from forming_sim.msg import PlasticStrainTopology

SHIPPED = '/forming_server'  # the topics in the shipped views
SHIPPED_FRAME = 'forming_world'
DISTANCE = {2: 1.6, 3: 2.1}  # of the camera, over the size of the bodies: from aside the near corner with the legend is large


def framed(view, dimension, low, high):
    """The view with its camera on the box from low to high and the legend, which stands at lesser x."""
    size = max(h - l for l, h in zip(low, high))
    camera = view['Visualization Manager']['Views']['Current']
    centre = [(l + h) / 2 for l, h in zip(low, high)]
    centre[0] -= 0.15 * size
    camera['Focal Point'] = dict(zip('XYZ', centre))
    camera['Focal Shape Size'] = 0.02 * size
    camera['Distance'] = DISTANCE[dimension] * size
    camera['Near Clip Distance'] = 0.02 * size
    return view


def save(view, topics):
    """Writes the view of these topics where rviz can open it; returns the path. Views of other topics may be opened at the same time."""
    os.makedirs(rospkg.get_ros_home(), exist_ok=True)
    path = os.path.join(rospkg.get_ros_home(), 'forming_view%s.rviz' % topics.replace('/', '_'))
    with open(path, 'w') as file:
        yaml.safe_dump(view, file, sort_keys=False)
    return path


def load(path, topics, frame):
    """The shipped view, on these topics and in this frame."""
    with open(path) as file:
        view = yaml.safe_load(file.read().replace(SHIPPED + '/', topics + '/'))
    view['Visualization Manager']['Global Options']['Fixed Frame'] = frame
    return view


def split(arguments):
    """What is given by its place, and the rest: options of rviz and remappings."""
    places = next((i for i, a in enumerate(arguments) if re.match('-|__|.*:=', a)), len(arguments))
    return arguments[:places], arguments[places:]


def main():
    given, options = split(sys.argv[1:])
    name, given, frame = given + ['', 'forming_server', SHIPPED_FRAME][len(given):] if len(given) <= 3 else sys.exit(__doc__)
    topics = rospy.names.resolve_name(given, rospy.names.get_namespace() + 'view')
    views = os.path.join(rospkg.RosPack().get_path('forming_sim'), 'rviz')
    path = os.path.join(views, name + '.rviz')
    if name == 'fit':
        rospy.init_node('rviz')
        print('rviz opens with the first run', flush=True)
        try:
            run = rospy.wait_for_message(topics + '/plastic_strain_topology', PlasticStrainTopology)
        except rospy.ROSInterruptException:
            return
        view = load(os.path.join(views, 'forming.rviz' if run.dimension == 2 else 'forming_3d.rviz'), topics, frame)
        nodes = [(p.x, p.y, p.z) for p in run.nodes]
        path = save(framed(view, run.dimension, [min(column) for column in zip(*nodes)], [max(column) for column in zip(*nodes)]), topics)
        rospy.signal_shutdown('rviz takes its name')
    elif not os.path.exists(path):
        known = sorted(f[:-5] for f in os.listdir(views) if f.endswith('.rviz'))
        sys.exit(f"forming_view.py: given '{name}'; give fit or one of the views {', '.join(known)}")
    elif (topics, frame) != (SHIPPED, SHIPPED_FRAME):
        path = save(load(path, topics, frame), topics)
    os.execvp('rviz', ['rviz', '-d', path] + options)


main()
