# Draws refinement.svg and refinement.png: gnuplot refinement.gp
set encoding utf8
do for [kind in 'svg png'] {
if (kind eq 'svg') {
set terminal svg size 900,520 font 'sans,14' background 'white'
} else {
set terminal pngcairo size 1350,780 font 'sans,18'
}
set output 'refinement.'.kind
set datafile separator ','
set datafile missing NaN
set title 'Error of the elements against their size'
set xlabel 'cells across the bar'
set ylabel 'error'
set grid lc rgb '#dddddd' lt 1
set key outside right top Left reverse
set tics nomirror
set border 3
set logscale x
set format x '%g'
set logscale y
set format y '%g'
plot \
  'large.csv' using ((strcol('part') eq 'refinement' && strcol('motion') eq 'twist' && strcol('elements') eq '4' ? column('cells') : NaN)):(column('error')) with linespoints lc rgb '#0072b2' lw 2 pt 7 ps 0.8 dt 2 title 'bar twisted, 4 nodes', \
  'large.csv' using ((strcol('part') eq 'refinement' && strcol('motion') eq 'twist' && strcol('elements') eq '10' ? column('cells') : NaN)):(column('error')) with linespoints lc rgb '#0072b2' lw 2 pt 7 ps 0.8 dt 1 title 'bar twisted, 10 nodes', \
  'large.csv' using ((strcol('part') eq 'refinement' && strcol('motion') eq 'bend' && strcol('elements') eq '4' ? column('cells') : NaN)):(column('error')) with linespoints lc rgb '#d55e00' lw 2 pt 5 ps 0.8 dt 2 title 'bar bent, 4 nodes', \
  'large.csv' using ((strcol('part') eq 'refinement' && strcol('motion') eq 'bend' && strcol('elements') eq '10' ? column('cells') : NaN)):(column('error')) with linespoints lc rgb '#d55e00' lw 2 pt 5 ps 0.8 dt 1 title 'bar bent, 10 nodes', \
  'large.csv' using ((strcol('part') eq 'refinement' && strcol('motion') eq 'stretch' && strcol('elements') eq '4' ? column('cells') : NaN)):(column('error')) with linespoints lc rgb '#009e73' lw 2 pt 9 ps 0.8 dt 2 title 'bar stretched, 4 nodes', \
  'large.csv' using ((strcol('part') eq 'refinement' && strcol('motion') eq 'stretch' && strcol('elements') eq '10' ? column('cells') : NaN)):(column('error')) with linespoints lc rgb '#009e73' lw 2 pt 9 ps 0.8 dt 1 title 'bar stretched, 10 nodes'
unset output
reset
}
