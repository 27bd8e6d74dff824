#!/usr/bin/python3
"""Bad input from the outside: forming_offline answers with a sentence and an exit code, and never crashes.

usage: bad_input_test.py FORMING_OFFLINE
"""
import copy
import json
import math
import os
import resource
import shutil
import signal
import subprocess
import sys
import time
import unittest

import h5py
import numpy
import yaml

from own_directory import OwnDirectory

OFFLINE = sys.argv.pop(1) if len(sys.argv) > 1 else ''

SCENE = {
    'name': 'pressed', 'dimension': 2,
    'bodies': [{
        'name': 'strip',
        'blank': {'shape': 'strip', 'length': 0.010, 'thickness': 0.001, 'cells_along': 10, 'cells_through': 2},
        'material': {'density': 2710.0, 'youngs_modulus': 70.5e9, 'poissons_ratio': 0.34,
                     'hardening': {'curve': 'perfect', 'yield_stress': 192.1e6}},
        'boundaries': [{'set': 'bottom', 'kind': 'fixed', 'axes': ['y']}]}],
    'tools': [{'name': 'press', 'point': [0.0, 0.001, 0.0], 'normal': [0.0, -1.0, 0.0],
               'motion': {'kind': 'velocity', 'times': [0.0, 5e-6], 'velocities': [[0.0, 0.0, 0.0], [0.0, -5.0, 0.0]]}}],
    'stages': [{'kind': 'form', 'duration': 2e-5}],
    'output': {'frames': 4}}

PLATE = {
    'name': 'plate', 'dimension': 3,
    'bodies': [{
        'name': 'plate',
        'blank': {'shape': 'plate', 'length': 0.010, 'width': 0.010, 'thickness': 0.001,
                  'cells_along': 4, 'cells_across': 4, 'cells_through': 1},
        'material': SCENE['bodies'][0]['material'],
        'boundaries': [{'set': 'bottom', 'kind': 'fixed', 'axes': ['z']}]}],
    'tools': [{'name': 'die', 'mesh': {'url': 'die.stl', 'unit_scale': 0.001},
               'motion': {'kind': 'velocity', 'times': [0.0, 5e-6], 'velocities': [[0.0, 0.0, 0.0], [0.0, 0.0, -5.0]]}}],
    'stages': [{'kind': 'form', 'duration': 5e-6}],
    'output': {'frames': 2}}

SQUARE = [[0.0, 0.0, 0.0], [0.01, 0.0, 0.0], [0.01, 0.01, 0.0], [0.0, 0.01, 0.0]]


def box(low, high):
    """The twelve outward facets of a box."""
    p = [[(low, high)[i >> a & 1][a] for a in range(3)] for i in range(8)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return [[p[i] for i in t] for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def stl(facets):
    lines = ['solid die']
    for facet in facets:
        lines += ['facet normal 0 0 0', 'outer loop'] + ['vertex %g %g %g' % tuple(v) for v in facet] + ['endloop', 'endfacet']
    return '\n'.join(lines + ['endsolid die', ''])


DIE = box((-1, -1, 1.0), (11, 11, 3.0))  # millimetres, on the plate's top


class BadInput(OwnDirectory):
    def write(self, name, text):
        with open(self.path(name), 'wb' if isinstance(text, bytes) else 'w') as file:
            file.write(text)

    def offline(self, *arguments, **keywords):
        run = subprocess.run([OFFLINE, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors='replace', timeout=120, **keywords)
        self.assertGreaterEqual(run.returncode, 0, 'killed by signal %d\n%s' % (-run.returncode, run.stderr))
        self.assertNotIn('terminate called', run.stderr)
        self.said = run.stdout + run.stderr
        return run

    def refused(self, scene, *words, output=None, **keywords):
        """The scene (a dictionary or a text) is refused, and every word is in what is said."""
        self.write('scene.yaml', scene if isinstance(scene, (str, bytes)) else yaml.safe_dump(scene))
        run = self.offline(self.path('scene.yaml'), '--output', output or self.path('out'), '--quiet', '--threads', '1', **keywords)
        self.assertNotEqual(run.returncode, 0, run.stdout)
        for word in words:
            self.assertIn(word, run.stderr)
        if os.environ.get('SHOW'):
            print('%s: exit %d\n%s' % (self.id(), run.returncode, run.stderr))
        return run

    def changed(self, path, value, base=SCENE):
        """The scene with one field set, made or (value None) removed."""
        scene = copy.deepcopy(base)
        at = scene
        for key in path[:-1]:
            at = at[key]
        if value is None:
            del at[path[-1]]
        else:
            at[path[-1]] = value
        return scene

    def test_the_scenes_themselves_run(self):
        for scene in (SCENE, PLATE):
            self.write('die.stl', stl(DIE))
            self.write('scene.yaml', yaml.safe_dump(scene))
            run = self.offline(self.path('scene.yaml'), '--output', self.path('out'), '--quiet', '--threads', '1')
            self.assertEqual(run.returncode, 0, self.said)

    # ---- numbers

    def test_numbers_that_are_none(self):
        material = ('bodies', 0, 'material')
        for path, value, word in (
                (material + ('density',), math.nan, 'nan'), (material + ('density',), -2710.0, '-2710'),
                (material + ('youngs_modulus',), math.inf, 'inf'), (material + ('youngs_modulus',), 0.0, '0'),
                (material + ('poissons_ratio',), 0.5, '0.5'),
                (material + ('hardening', 'yield_stress'), math.nan, 'nan'),
                (('bodies', 0, 'blank', 'length'), math.nan, 'nan'), (('bodies', 0, 'blank', 'cells_along'), 0, '0'),
                (('stages', 0, 'duration'), -1.0, '-1'), (('stages', 0, 'duration'), math.inf, 'inf'),
                (('dimension',), 4, '4')):
            with self.subTest(path=path, value=value):
                field = '.'.join(str(p) for p in path[-2:] if not isinstance(p, int))
                self.refused(self.changed(path, value), field.split('.')[-1], 'given', word, 'give')

    def test_vectors_that_are_none(self):
        self.refused(self.changed(('tools', 0, 'normal'), [0.0, 0.0, 0.0]), 'tools[0]', 'normal of length 0')
        self.refused(self.changed(('tools', 0, 'point'), [0.0, math.nan, 0.0]), 'tools[0].point', 'nan')
        self.refused(self.changed(('bodies', 0, 'initial_velocity'), [math.nan, 0.0, 0.0]), 'bodies[0].initial_velocity', 'nan')
        self.refused(self.changed(('tools', 0, 'motion', 'velocities'), [[0.0, 0.0, 0.0], [0.0, math.nan, 0.0]]), 'velocities', 'nan')
        self.refused(self.changed(('tools', 0, 'motion', 'times'), [5e-6, 0.0]), 'tools[0].motion.times')

    def test_what_goes_farther_than_numbers_reach_is_named(self):
        for path in (('bodies', 0, 'initial_velocity'), ('gravity',)):
            self.refused(self.changed(path, [1e80, 0.0, 0.0]), 'farther than numbers reach', 'time 0 s')
        self.refused(self.changed(('bodies', 0, 'initial_velocity'), [1e200, 0.0, 0.0]), 'bodies[0].initial_velocity', '1e100')

    def test_a_layer_that_is_thicker_than_the_body(self):
        self.refused(self.changed(('contact',), {'layer': 0.5}), 'contact.layer', '0.5', 'thinnest body')

    def test_more_threads_than_the_system_starts(self):
        self.write('scene.yaml', yaml.safe_dump(SCENE))
        few = lambda: resource.setrlimit(resource.RLIMIT_AS, (3 << 30, 3 << 30))  # stacks take 8 MiB each of it
        run = self.offline('--estimate', self.path('scene.yaml'), '--threads', '1000', preexec_fn=few)
        self.assertEqual(run.returncode, 2, self.said)
        self.assertIn('threads: given 1000; the system starts no more than', self.said)

    def test_words_in_place_of_numbers(self):
        self.refused(self.changed(('bodies', 0, 'material', 'density'), 'heavy'), 'bodies[0].material.density', 'heavy')
        self.refused(self.changed(('bodies', 0, 'blank'), 'strip'), 'bodies[0].blank')
        self.refused(self.changed(('stages',), 'form'), 'stages')

    # ---- fields

    def test_unknown_and_missing_fields(self):
        self.refused(self.changed(('bodies', 0, 'material', 'densty'), 1.0), 'densty', 'density')
        self.refused(self.changed(('bodies', 0, 'material', 'density'), None), 'bodies[0].material.density', 'required')
        self.refused(self.changed(('stages',), None), 'stages', 'required')
        self.refused(self.changed(('bodies', 0, 'material', 'hardening', 'curve'), 'volce'), 'volce', 'voce')

    def test_a_missing_set(self):
        self.refused(self.changed(('bodies', 0, 'boundaries', 0, 'set'), 'nowhere'), 'bodies[0].boundaries[0].set', 'nowhere', 'bottom')

    def test_all_faults_are_told_at_once(self):
        scene = self.changed(('bodies', 0, 'boundaries', 0, 'set'), 'nowhere')
        scene['bodies'][0]['material']['density'] = math.nan
        scene['output']['framse'] = 3
        self.refused(scene, 'nowhere', 'density', 'framse')

    # ---- the file

    def test_files_that_are_no_scene(self):
        self.refused('', 'scene')
        self.refused('bodies: [}', 'line 1')
        self.refused('- a\n- b\n', 'scene')
        self.refused(os.urandom(4096), 'scene')
        self.refused('a: &a [*a]\n', 'scene')
        run = self.offline(self.path('none.yaml'), '--output', self.path('out'))
        self.assertNotEqual(run.returncode, 0)
        self.assertIn('none.yaml', run.stderr)
        run = self.offline(self.directory, '--output', self.path('out'))
        self.assertNotEqual(run.returncode, 0)

    # ---- meshes of bodies

    def body(self, **mesh):
        scene = self.changed(('bodies', 0, 'blank'), None)
        scene['bodies'][0]['mesh'] = dict({'unit_scale': 1.0}, **mesh)
        scene['bodies'][0]['boundaries'] = []
        scene['tools'] = []
        return scene

    def test_inline_meshes(self):
        def cells(*indices, points=SQUARE, kind='quadrilateral'):
            return self.body(points=points, cells=list(indices), cell_type=kind)
        self.write('scene.yaml', yaml.safe_dump(cells(0, 1, 2, 3)))
        self.assertEqual(self.offline(self.path('scene.yaml'), '--output', self.path('out')).returncode, 0, self.said)
        self.refused(cells(0, 1, 2, 0, 1, 3, kind='triangle'), 'bodies[0].mesh', 'same side')
        self.refused(cells(0, 1, 3, 2), 'bodies[0].mesh')
        self.refused(cells(0, 1, 2, 4), 'bodies[0].mesh', '4')
        self.refused(cells(0, 1, 2), 'bodies[0].mesh')
        self.refused(cells(), 'bodies[0].mesh')
        self.refused(cells(0, 1, 1, 2), 'bodies[0].mesh')
        self.refused(cells(0, 1, 2, 3, points=SQUARE[:3] + [[0.0, math.nan, 0.0]]), 'bodies[0].mesh', 'nan')
        corners = [[0.0, 0.0, 0.0], [0.01, 0.0, 0.0], [0.0, 0.01, 0.0], [0.0, 0.0, 0.01], [0.0, 0.0, -0.01]]
        solid = self.body(points=corners, cells=[0, 2, 1, 3, 0, 2, 1, 4], cell_type='tetrahedron')
        solid['dimension'] = 3
        self.refused(solid, 'bodies[0].mesh', 'inverted', 'positive volume')
        self.refused(cells(0, 1, 2, 3, kind='pentagon'), 'bodies[0].mesh.cell_type', 'pentagon')

    def test_a_refused_scene_says_that_the_other_files_are_of_an_earlier_run(self):
        def summary():
            with open(self.path('out/summary.json')) as file:
                return json.load(file)
        self.refused(self.changed(['dimension'], 7), 'dimension')
        self.assertNotIn('warnings', summary())
        self.write('scene.yaml', yaml.safe_dump(SCENE))
        self.assertEqual(self.offline(self.path('scene.yaml'), '--output', self.path('out'), '--quiet').returncode, 0, self.said)
        self.refused(self.changed(['dimension'], 7), 'dimension')
        self.assertIn('of an earlier run', summary()['warnings'][0])
        self.assertTrue(os.path.exists(self.path('out/result.h5')))

    def test_mesh_files(self):
        self.refused(self.body(url='none.msh'), 'bodies[0].mesh.url', 'none.msh')
        self.write('empty.msh', '')
        self.refused(self.body(url='empty.msh'), 'bodies[0].mesh', 'empty.msh')
        self.write('noise.msh', os.urandom(2000))
        self.refused(self.body(url='noise.msh'), 'bodies[0].mesh', 'noise.msh')
        self.write('cut.msh', '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n')
        self.refused(self.body(url='cut.msh'), 'bodies[0].mesh', 'cut.msh')
        text = '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 %s 0 0\n3 0 .01 0\n$EndNodes\n$Elements\n1\n1 2 2 0 1 %s\n$EndElements\n'
        self.write('good.msh', text % ('.01', '1 2 3'))
        self.write('scene.yaml', yaml.safe_dump(self.body(url='good.msh')))
        self.assertEqual(self.offline(self.path('scene.yaml'), '--output', self.path('out')).returncode, 0, self.said)
        self.write('nan.msh', text % ('nan', '1 2 3'))
        self.refused(self.body(url='nan.msh'), 'bodies[0].mesh', 'nan.msh')
        self.refused(self.body(url='good.msh', group='sheet'), "bodies[0].mesh.group: given 'sheet'", 'physical group')
        self.refused(self.body(url='good.msh', unit_scale=0.0), 'bodies[0].mesh.unit_scale')
        scene = self.body(url='good.msh')
        scene['dimension'] = 3
        self.refused(scene, 'bodies[0].mesh')

    # ---- tools

    def tool(self, text, name='die.stl', **mesh):
        self.write(name, text)
        return self.changed(('tools', 0, 'mesh'), dict({'url': name, 'unit_scale': 0.001}, **mesh), PLATE)

    def test_tool_files(self):
        self.refused(self.tool(''), 'tools[0].mesh', 'die.stl')
        self.refused(self.tool(stl([])), 'tools[0].mesh', 'die.stl')
        self.refused(self.tool(os.urandom(3000)), 'tools[0].mesh', 'die.stl')
        self.refused(self.tool(stl([[[0, 0, 1], [0, 0, 1], [1, 0, 1]]])), 'tools[0].mesh', 'die.stl')
        self.refused(self.tool(stl([[[0, 0, math.nan], [0, 1, 1], [1, 0, 1]]] + DIE)), 'tools[0].mesh', 'die.stl')
        self.refused(self.tool('x', name='die.step'), 'tools[0].mesh.url', 'die.step')

    def test_a_die_in_millimetres(self):
        self.refused(self.tool(stl(DIE), unit_scale=1.0), 'tools[0].mesh.unit_scale', '0.001')
        self.refused(self.tool(stl(DIE), unit_scale=1e-6), 'tools[0].mesh.unit_scale')
        scene = self.tool(stl(DIE))
        del scene['tools'][0]['mesh']['unit_scale']
        self.refused(scene, 'tools[0].mesh.unit_scale', 'required')

    def test_a_tool_inside_the_blank(self):
        self.refused(self.tool(stl(box((-1, -1, .5), (11, 11, 3)))), 'tool die', '0.0005', 'node')

    def test_an_open_tool_runs_and_is_told(self):
        scene = self.tool(stl(DIE[2:]))  # a die without its underside's far face
        self.write('scene.yaml', yaml.safe_dump(scene))
        run = self.offline(self.path('scene.yaml'), '--output', self.path('out'), '--threads', '1')
        self.assertIn('open', self.said)

    # ---- size

    def test_a_mesh_beyond_the_memory(self):
        self.refused(self.changed(('bodies', 0, 'blank'), dict(SCENE['bodies'][0]['blank'], cells_along=1000000, cells_through=1000000)),
                     'bodies[0].blank', 'fewer cells')

    # ---- output

    def test_output_that_cannot_be_written(self):
        self.refused(SCENE, '/proc/nowhere', output='/proc/nowhere')
        self.write('file', 'in the way')
        self.refused(SCENE, 'file', output=self.path('file'))
        self.refused(SCENE, '/dev/full', output='/dev/full')

    def test_a_full_disk(self):
        def small():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (60000, 60000))
        scene = self.changed(('output', 'frames'), 100)
        run = self.refused(scene, self.path('out'), preexec_fn=small)
        self.assertIn('write', run.stderr)

    def test_standard_files_that_are_closed(self):
        self.write('scene.yaml', yaml.safe_dump(SCENE))
        line = 'exec 0<&- 1>&- 2>&-; exec "$0" "$1" --output "$2" --threads 1'
        self.assertEqual(subprocess.run(['bash', '-c', line, OFFLINE, self.path('scene.yaml'), self.path('out')], timeout=120).returncode, 0)
        with h5py.File(self.path('out/result.h5')) as result:
            self.assertGreater(len(result['frames']), 1)

    def test_a_cancel_whose_checkpoint_cannot_be_written(self):
        self.write('scene.yaml', yaml.safe_dump(self.changed(('stages', 0, 'duration'), 1.0)))
        os.makedirs(self.path('out/checkpoint.h5/in_the_way'))
        run = subprocess.Popen([OFFLINE, self.path('scene.yaml'), '--output', self.path('out'), '--threads', '1', '--quiet'], stderr=subprocess.PIPE, text=True)
        while not os.path.exists(self.path('out/history.csv')):
            self.assertIsNone(run.poll(), 'it ended by itself')
            time.sleep(0.01)
        run.send_signal(signal.SIGINT)
        said = run.communicate(timeout=60)[1]
        self.assertEqual(run.returncode, 1)
        self.assertIn('cancelled at', said)
        self.assertIn('checkpoint.h5', said)
        self.assertFalse(os.path.exists(self.path('out/checkpoint.h5.part')))

    def test_a_resume_with_files_that_are_another_run_s(self):
        scene = self.changed(('output', 'checkpoint_interval'), 1e-6)
        self.write('scene.yaml', yaml.safe_dump(scene))
        words = (self.path('scene.yaml'), '--quiet', '--threads', '1', '--output')
        self.assertEqual(self.offline(*words, self.path('out')).returncode, 0, self.said)
        resume = words + (self.path('out'), '--resume', self.path('checkpoint.h5'))
        shutil.copy(self.path('out/checkpoint.h5'), self.path('checkpoint.h5'))
        with h5py.File(self.path('out/result.h5')) as result:
            frames = len(result['frames'])
        # A remark in the scene changes nothing.
        self.write('scene.yaml', '# a remark\n' + yaml.safe_dump(scene))
        self.assertEqual(self.offline(*resume).returncode, 0, self.said)
        with h5py.File(self.path('out/result.h5')) as result:
            self.assertEqual(len(result['frames']), frames)
        # Texts whose length is damaged: the library would break over them, or read on for ever.
        with open(self.path('out/result.h5'), 'rb') as file:
            sound = file.read()
        texts = sound.index(b'GCOL')
        refused = 0
        for place in range(texts + 8, texts + 72, 4):
            with open(self.path('out/result.h5'), 'wb') as file:
                file.write(sound[:place] + b'\xff\x7f' + sound[place + 2:])
            code = self.offline(*resume).returncode
            self.assertIn(code, (0, 1), self.said)
            if code == 1:
                refused += 1
                self.assertIn('cannot go on with', self.said)
        self.assertGreater(refused, 3)
        # A file that is none of its first part stays as it is.
        self.write('out/result.h5', 'not HDF5')
        self.assertEqual(self.offline(*resume).returncode, 1)
        self.assertIn('cannot go on with', self.said)
        with open(self.path('out/result.h5')) as file:
            self.assertEqual(file.read(), 'not HDF5')

    # ---- a run that fails

    def test_a_mesh_that_has_changed_since_the_checkpoint(self):
        self.write('die.stl', stl(DIE))
        self.write('scene.yaml', yaml.safe_dump(self.changed(('output', 'checkpoint_interval'), 1e-6, PLATE)))
        words = (self.path('scene.yaml'), '--output', self.path('out'), '--quiet', '--threads', '1')
        self.assertEqual(self.offline(*words).returncode, 0, self.said)
        shutil.copy(self.path('out/checkpoint.h5'), self.path('checkpoint.h5'))
        resume = words + ('--resume', self.path('checkpoint.h5'))
        self.assertEqual(self.offline(*resume).returncode, 0, self.said)
        # However its place is spelled, it is the same file.
        with open(self.path('scene.yaml')) as file:
            spelled = yaml.safe_load(file)
        spelled['tools'][0]['mesh']['url'] = 'file://' + self.path('die.stl')
        self.write('spelled.yaml', yaml.safe_dump(spelled))
        self.assertEqual(self.offline(self.path('spelled.yaml'), *resume[1:]).returncode, 0, self.said)
        self.write('die.stl', stl(box((-1, -1, 1.0), (10.5, 11, 3.0))))
        self.assertEqual(self.offline(*resume).returncode, 1)
        self.assertIn("url: die.stl, content ", self.said)

    def test_what_the_last_step_turns_inside_out_is_no_success(self):
        driven = self.changed(('tools',), None)
        driven['bodies'][0]['boundaries'].append({'set': 'top', 'kind': 'velocity', 'axes': ['y'], 'times': [0.0], 'velocities': [[0.0, -1e3, 0.0]]})
        driven['time_step'] = {'mass_scaling': 1e6}  # one step is the run
        driven['stages'] = [{'kind': 'form', 'duration': 2e-6}]
        self.refused(driven, 'mesh_error', 'turned inside out', 'step 1')

    def test_an_estimate_of_what_breaks_at_once(self):
        driven = self.changed(('tools',), None)
        driven['bodies'][0]['boundaries'].append({'set': 'top', 'kind': 'velocity', 'axes': ['y'], 'times': [0.0], 'velocities': [[0.0, -1e6, 0.0]]})
        self.write('scene.yaml', yaml.safe_dump(driven))
        for word in ('--estimate', '--plan'):
            run = self.offline(word, self.path('scene.yaml'))
            self.assertEqual(run.returncode, 0, self.said)
            self.assertIn('elements     80', run.stdout)
            self.assertIn('note: the run breaks in its first steps: ', run.stdout)

    def test_a_run_that_breaks_keeps_its_files(self):
        scene = self.changed(('bodies', 0, 'boundaries'), [
            {'set': 'left', 'kind': 'fixed'},
            {'set': 'right', 'kind': 'velocity', 'axes': ['x'], 'times': [0.0, 1e-7], 'velocities': [[0.0, 0.0, 0.0], [-1e5, 0.0, 0.0]]}])
        scene['tools'] = []
        self.refused(scene, 'element', 'time')
        for name in ('result.h5', 'summary.json', 'history.csv'):
            self.assertTrue(os.path.getsize(self.path('out/' + name)) > 0, name)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1] + sys.argv[1:])
