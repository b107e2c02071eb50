#!/usr/bin/perl
# check_std_includes.pl SRC: fails when a header of SRC names something of the standard library whose header neither it
# nor a header of ours that it includes includes. Prints every such name. That headers compile on their own is checked by
# compiling them behind precompiled third-party headers, which would hide just this.
use strict;
use warnings;
use File::Find;

my %header_of = (
    vector => 'vector', string => 'string', string_view => 'string_view', optional => 'optional', span => 'span',
    function => 'functional', unique_ptr => 'memory', shared_ptr => 'memory', weak_ptr => 'memory', array => 'array',
    map => 'map', unordered_map => 'unordered_map', set => 'set', mutex => 'mutex', variant => 'variant',
    atomic => 'atomic', jthread => 'thread', future => 'future', filesystem => 'filesystem', ostream => 'iosfwd',
    uint64_t => 'cstdint', int64_t => 'cstdint', uint32_t => 'cstdint', chrono => 'chrono', numeric_limits => 'limits',
    complex => 'complex', deque => 'deque', bitset => 'bitset', exception_ptr => 'exception');
my %also = (iosfwd => [qw(ostream iostream fstream sstream)]);

chdir shift @ARGV or die "usage: check_std_includes.pl SRC\n";
my (%text, %ours, %std);
find(sub {
    return unless /\.hpp$/;
    (my $name = $File::Find::name) =~ s{^\./}{};
    open my $in, '<', $_ or die "$name: $!\n";
    local $/;
    my $all = <$in>;
    $ours{$name} = [$all =~ /^\s*#\s*include\s*"([^"]+)"/mg];
    $std{$name} = [$all =~ /^\s*#\s*include\s*<([a-z_]+)>/mg];
    $all =~ s{//[^\n]*}{}g;
    $text{$name} = $all;
}, '.');

sub reach {
    my ($name, $seen) = @_;
    return if $seen->{$name}++;
    reach($_, $seen) for @{$ours{$name} // []};
}

my $findings = 0;
for my $name (sort keys %text) {
    reach($name, \my %seen);
    my %included = map { $_ => 1 } map { @{$std{$_} // []} } keys %seen;
    my %used = map { $_ => 1 } $text{$name} =~ /\bstd::([a-z_0-9]+)/g;
    for my $word (sort keys %used) {
        my $header = $header_of{$word} // next;
        next if grep { $included{$_} } $header, @{$also{$header} // []};
        print "$name: names std::$word without <$header>\n";
        ++$findings;
    }
}
print scalar(keys %text), " headers, $findings findings\n";
exit($findings == 0 && %text ? 0 : 1);
